<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
    <context>
        <name>terrawalk::gui::StepCard</name>
        <message numerus="yes">
            <source>%n more setting(s)</source>
            <translation>
                <numerusform>%n more setting</numerusform>
                <numerusform>%n more settings</numerusform>
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
