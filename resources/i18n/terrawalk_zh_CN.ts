<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
<context>
    <name>AccuracyWords</name>
    <message>
        <source>Height RMSE %1 against the last run (%2 → %3 m).</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MapFurniture</name>
    <message>
        <source>Height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height, 1 σ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Density</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Source</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Track, speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Track, height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Track, plan 1 σ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Track, height 1 σ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GNSS fix</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>errors at marks %1 times as long</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MapScene</name>
    <message>
        <source>RTK fixed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RTK float</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DGNSS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>single</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not told</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>RasterPicture</name>
    <message>
        <source>measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>points/m²</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Steps</name>
    <message>
        <source>Import</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tune</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fuse</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Method</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GNSS heights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Barometer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Optical flow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Clean</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Longest range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drop outliers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drop plants</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cell size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Terrace edges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::AccuracyModel</name>
    <message>
        <source>Stage</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compared</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>n</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Plan RMSE</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height mean</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>SD</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Largest</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::AccuracyPanel</name>
    <message>
        <source>Nothing to judge yet. Process the survey: its errors at the marks will stand here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Errors by group, in metres</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Surface less mark, the largest first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the marks say</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What could not be checked</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Warnings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mark</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Role</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height error (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Predicted σ (m)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Error / σ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>control</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>check</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::ExportDialog</name>
    <message>
        <source>Export the results</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder for DEM, uncertainty, mesh, tracks, points and report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder for the results</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Further formats, into a folder beside it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same on the command line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Copy command</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Name a folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This is a file: name a folder.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 does not exist: make it first, or choose another place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>You may not write there: choose another place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>An earlier export there is replaced in one step.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points, LAS 1.4</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points, PLY</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points, PCD</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points, CSV</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Points, GeoPackage</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mesh, STL</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mesh, LandXML</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mesh, DXF</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DEM, ESRI ASCII</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::MainWindow</name>
    <message>
        <source>Surveys (*.json);;All files (*)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings (*.json);;All files (*)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accuracy</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Messages</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Place</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Steps</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open &amp;recent</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>None yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Start page</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Save settings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Load settings…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Load settings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Process</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Tune on the marks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Copy as co&amp;mmand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>E&amp;xclude what is selected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exclude &amp;only</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>range (no ground points)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GNSS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>barometer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>optical flow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>attitude</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Dark or light</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>中文 / English</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;What is this?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;About Terrawalk</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>working</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not processed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>settings changed: process again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>up to date</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel what is running first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Copied: %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tuned values travel in a file: save the settings, then copy again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1[*] – Terrawalk</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Terrawalk</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>draw a line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line drawn: process again, and the surface keeps to it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>exclude a stretch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 is left out from %2 to %3 s: process again to see what it changes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>leave out %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>take %1 back in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take back in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>take back an edit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>About Terrawalk</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&lt;h3&gt;Terrawalk %1&lt;/h3&gt;&lt;p&gt;From a walk with the sensor array to a terrain model that you can sign for.&lt;/p&gt;&lt;p&gt;Free software, see LICENSE. Built with Eigen, CGAL, PCL, GDAL, PROJ, OctoMap and Qt.&lt;/p&gt;</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::MapPanel</name>
    <message>
        <source>Map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Layer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the ground is coloured by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shaded heights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Point density</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Source of heights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No ground</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Colour of the tracks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the tracks are coloured by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracks by run</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracks by fix</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracks by speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracks by height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracks by plan σ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracks by height σ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Contours</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Contours of the surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move and ask</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drag moves the map; a click tells what is there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select a stretch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drag along a track, then exclude what was selected.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click points; length and area stand beside them. A double click ends it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Profile</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click a line; a double click shows the heights along it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw a breakline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click along an edge where the surface folds; a double click ends it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw a soft breakline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Triangles keep to it, and the surface stays smooth across it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw the boundary</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing outside it is ground.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw a hole</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing inside it is ground, e.g. a pond.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show all (Home)</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::MapView</name>
    <message>
        <source>Map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>E %1 m   N %2 m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>   height %1 m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, area %1 m²</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::PlacePanel</name>
    <message>
        <source>a point lies in this cell</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>between points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>far from any point</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where the uncertainty comes from</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Height of the track</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Track in plan × slope</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Attitude × range × slope</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Between points, noise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nearest hits</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Run, time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>away</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>height</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>σ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 %2 s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click the map: this panel tells the height there, how sure it is, and why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no surface</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>E %1, N %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> · slope %1° · %2 m to the nearest point · %3 points/m² · %4</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::SettingEditor</name>
    <message>
        <source>&lt;p&gt;%1&lt;/p&gt;&lt;p&gt;Permitted: %2&lt;br&gt;Default: %3&lt;br&gt;&lt;tt&gt;%4&lt;/tt&gt;&lt;/p&gt;</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::ShortcutsDialog</name>
    <message>
        <source>Keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Arrows</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move the map</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Zoom in and out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show all</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>End a line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the last vertex back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave the tool, select nothing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Window</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tools</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>On the map</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::StartPage</name>
    <message>
        <source>Quick plot: a small one, done in a second</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mango orchard: terraces, plants, poor GNSS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From a walk to a terrain model that you can sign for.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a survey…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A survey.json, or a folder that holds one. Or drop it onto this window.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>or drop a survey.json, or its folder, onto this window</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Samples: one click to a finished DEM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Recent surveys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>None yet: the surveys that you open will stand here.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::StepCard</name>
    <message numerus="yes">
        <source>%n more setting(s)</source>
        <translation type="unfinished">
            <numerusform></numerusform>
        </translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::StepsPanel</name>
    <message>
        <source>Open a survey…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A survey.json, or the folder that holds one</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tune on the marks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Searches noise parameters of the method that make errors at control marks small, and takes them only where they hold out better on marks left out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Writes DEM, mesh, tracks and report into a folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Copy as command</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The terrawalk command line that makes the same files</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Earlier runs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Earlier runs: choosing one shows its results and takes its settings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the accuracy</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Errors at marks, group by group</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Process</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fuse, clean, make the surface and check it (F5)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop what is running; nothing is lost (Esc)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 · %2 left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 · %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message numerus="yes">
        <source>%n run(s)</source>
        <translation type="unfinished">
            <numerusform></numerusform>
        </translation>
    </message>
    <message>
        <source>nothing open</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>tuned</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>defaults</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>changed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>done</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not checked yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Process the survey to see its errors at the marks.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Process again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>about 1 s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>about %1 s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>about %1 min</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>about %1 h</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::SurveySession</name>
    <message>
        <source>Cancelled; what was there before is still there.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Opened %1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> %1: %2.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Processed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>tune</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exported to %1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 = %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>load settings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings read from %1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1: cannot be written (%2); use &quot;Save settings as&quot; for another place</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Saved to %1.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The saved settings cannot be read: the defaults stand instead.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Changes cannot be kept against a crash: %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>unsaved changes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unsaved changes of the last time are back; undo takes them away.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>go back to an earlier run</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>terrawalk::gui::SurveyTreeModel</name>
    <message>
        <source>any reading</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GNSS</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>barometer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>optical flow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>attitude</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Survey</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Runs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>empty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Area run %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fixed-point run %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, starts on %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, ends on %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>; %1 records</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 m, %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>; %1 ground points used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Control mark: may hold the track</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check mark: only ever measures errors</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>control</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>check</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>; surface less mark %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Edits</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 without %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Breakline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Soft breakline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Boundary</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hole</source>
        <translation type="unfinished"></translation>
    </message>
    <message numerus="yes">
        <source>%n point(s)</source>
        <translation type="unfinished">
            <numerusform></numerusform>
        </translation>
    </message>
    <message>
        <source>Results</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DEM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>median %1 m</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 triangles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Terrace edges</source>
        <translation type="unfinished"></translation>
    </message>
</context>
</TS>
