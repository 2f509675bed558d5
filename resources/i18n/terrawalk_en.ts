<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
    <context>
        <name>terrawalk::gui::NewSurveyDialog</name>
        <message numerus="yes">
            <source>%n mark(s) in %1</source>
            <translation>
                <numerusform>%n mark in %1</numerusform>
                <numerusform>%n marks in %1</numerusform>
            </translation>
        </message>
        <message numerus="yes">
            <source>%n file(s) cannot be used: mend them and add them again, or take them out.</source>
            <translation>
                <numerusform>%n file cannot be used: mend it and add it again, or take it out.</numerusform>
                <numerusform>%n files cannot be used: mend them and add them again, or take them out.</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::MainWindow</name>
        <message numerus="yes">
            <source>exclude %n stretches</source>
            <translation>
                <numerusform>exclude a stretch</numerusform>
                <numerusform>exclude %n stretches</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::StepCard</name>
        <message numerus="yes">
            <source>%n more setting(s)…</source>
            <translation>
                <numerusform>%n more setting…</numerusform>
                <numerusform>%n more settings…</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::StepsPanel</name>
        <message numerus="yes">
            <source>%n run(s)</source>
            <translation>
                <numerusform>%n run</numerusform>
                <numerusform>%n runs</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::SurveySession</name>
        <message numerus="yes">
            <source>%n earlier run(s) cannot be read by this version and are left out.</source>
            <translation>
                <numerusform>%n earlier run cannot be read by this version and is left out.</numerusform>
                <numerusform>%n earlier runs cannot be read by this version and are left out.</numerusform>
            </translation>
        </message>
    </context>
    <context>
        <name>terrawalk::gui::SurveyTreeModel</name>
        <message numerus="yes">
            <source>%n point(s)</source>
            <translation>
                <numerusform>%n point</numerusform>
                <numerusform>%n points</numerusform>
            </translation>
        </message>
    </context>
</TS>
