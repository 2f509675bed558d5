#include "app/gui/report_words.hpp"

#include <QCoreApplication>
#include <string>

#include "app/gui/error_words.hpp"
#include "app/gui/language.hpp"
#include "app/gui/page_words.hpp"
#include "survey/chinese_words.hpp"

namespace terrawalk::gui {

namespace {

// What the core says in English. Here for the tool that collects texts; survey/chinese_words.hpp finds them,
// with numbers and names in them, in the table that it fills.
constexpr const char* kWords[] = {
    QT_TRANSLATE_NOOP("Report", "before fusion"),
    QT_TRANSLATE_NOOP("Report", "fused"),
    QT_TRANSLATE_NOOP("Report", "surface"),
    QT_TRANSLATE_NOOP("Report", "position on mark"),
    QT_TRANSLATE_NOOP("Report", "nearest ground point"),
    QT_TRANSLATE_NOOP("Report", "surface height"),
    QT_TRANSLATE_NOOP("Report", "control"),
    QT_TRANSLATE_NOOP("Report", "check"),
    QT_TRANSLATE_NOOP("Report", "Height error (RMSE)"),
    QT_TRANSLATE_NOOP("Report", "Height error of the surface (RMSE)"),
    QT_TRANSLATE_NOOP("Report", "Height error of the track (RMSE)"),
    QT_TRANSLATE_NOOP("Report", "Check marks compared"),
    QT_TRANSLATE_NOOP("Report", "Terrain model"),
    QT_TRANSLATE_NOOP("Report", "not known"),
    QT_TRANSLATE_NOOP("Report", "used"),
    QT_TRANSLATE_NOOP("Report", "no range"),
    QT_TRANSLATE_NOOP("Report", "range too short"),
    QT_TRANSLATE_NOOP("Report", "range too long"),
    QT_TRANSLATE_NOOP("Report", "weak return"),
    QT_TRANSLATE_NOOP("Report", "saturated"),
    QT_TRANSLATE_NOOP("Report", "tilted"),
    QT_TRANSLATE_NOOP("Report", "position unsure"),
    QT_TRANSLATE_NOOP("Report", "spike"),
    QT_TRANSLATE_NOOP("Report", "thinned"),
    QT_TRANSLATE_NOOP("Report", "run left out"),
    QT_TRANSLATE_NOOP("Report", "statistical outlier"),
    QT_TRANSLATE_NOOP("Report", "isolated"),
    QT_TRANSLATE_NOOP("Report", "above ground"),
    QT_TRANSLATE_NOOP("Report", "GNSS position"),
    QT_TRANSLATE_NOOP("Report", "heading row"),
    QT_TRANSLATE_NOOP("Report", "mark tie"),
    QT_TRANSLATE_NOOP("Report", "GNSS height"),
    QT_TRANSLATE_NOOP("Report", "GNSS velocity"),
    QT_TRANSLATE_NOOP("Report", "barometer"),
    QT_TRANSLATE_NOOP("Report", "optical flow"),
    QT_TRANSLATE_NOOP("Report", "mean optical flow"),
    QT_TRANSLATE_NOOP("Report", "accelerometer"),
    QT_TRANSLATE_NOOP("Report", "all readings"),
    QT_TRANSLATE_NOOP("Report", "runs are named as their logs are"),
    QT_TRANSLATE_NOOP("Report", "attitude"),
    QT_TRANSLATE_NOOP("Report", "range"),
    QT_TRANSLATE_NOOP("Report", "Drawn by hand: a line of the surface."),
    QT_TRANSLATE_NOOP("Report", "height assumption"),
    QT_TRANSLATE_NOOP("Report", "leave-one-out"),
    QT_TRANSLATE_NOOP("Report", "random-folds"),
    QT_TRANSLATE_NOOP("Report", "spatial-blocks"),
    QT_TRANSLATE_NOOP("Report", "reading"),
    QT_TRANSLATE_NOOP("Report", "writing"),
    QT_TRANSLATE_NOOP("Report", "comparing"),
    QT_TRANSLATE_NOOP("Report", "done"),
    QT_TRANSLATE_NOOP("Report", "adjusting all runs"),
    QT_TRANSLATE_NOOP("Report", "making the surface"),
    QT_TRANSLATE_NOOP("Report", "processed"),
    QT_TRANSLATE_NOOP("Report", "tuned"),
    QT_TRANSLATE_NOOP("Report", "searching"),
    QT_TRANSLATE_NOOP("Report", "triangulating"),
    QT_TRANSLATE_NOOP("Report", "gridding"),
    QT_TRANSLATE_NOOP("Report", "contours"),
    QT_TRANSLATE_NOOP("Report", "joining contours"),
    QT_TRANSLATE_NOOP("Report", "smoothing"),
    QT_TRANSLATE_NOOP("Report", "looking for statistical outliers"),
    QT_TRANSLATE_NOOP("Report", "looking for isolated points"),
    QT_TRANSLATE_NOOP("Report", "looking for what stands above the ground"),
    QT_TRANSLATE_NOOP("Report", "points cleaned"),
    QT_TRANSLATE_NOOP("Report", "looking for terrace edges"),
    QT_TRANSLATE_NOOP("Report", "placing rays"),
    QT_TRANSLATE_NOOP("Report", "following laser rays"),
    QT_TRANSLATE_NOOP("Report", "obstacles"),
    QT_TRANSLATE_NOOP("Report", "free height"),
    QT_TRANSLATE_NOOP("Report", "no ground point has a sound ray"),
    QT_TRANSLATE_NOOP("Report", "the ground layer must lie below the greatest height"),
    QT_TRANSLATE_NOOP("Report", "Space above the ground"),
    QT_TRANSLATE_NOOP("Report", "Rays"),
    QT_TRANSLATE_NOOP("Report", "Space"),
    QT_TRANSLATE_NOOP("Report", "Free"),
    QT_TRANSLATE_NOOP("Report", "Obstacles"),
    QT_TRANSLATE_NOOP("Report", "hashing the inputs"),
    QT_TRANSLATE_NOOP("Report", "fitting the variogram"),
    QT_TRANSLATE_NOOP("Report", "fitting the B-spline"),
    QT_TRANSLATE_NOOP("Report", "reading breaklines"),
    QT_TRANSLATE_NOOP("Report", "the surface"),
    QT_TRANSLATE_NOOP("Report", "the ground points"),
    QT_TRANSLATE_NOOP("Report", "the ground below the array"),
    QT_TRANSLATE_NOOP("Report", "none"),
    QT_TRANSLATE_NOOP("Report", "no mark was measured"),
    QT_TRANSLATE_NOOP("Report", "no check mark was compared"),
    QT_TRANSLATE_NOOP("Report", "none was measured"),
    QT_TRANSLATE_NOOP("Report", "no surface was made"),
    QT_TRANSLATE_NOOP("Report", "an unknown area"),
    QT_TRANSLATE_NOOP("Report", "too high"),
    QT_TRANSLATE_NOOP("Report", "too low"),
    QT_TRANSLATE_NOOP("Report", "No accuracy can be stated: the survey has no marks to compare with."),
    QT_TRANSLATE_NOOP("Report",
                      "No accuracy can be stated: no check mark could be compared with the product."),
    QT_TRANSLATE_NOOP("Report",
                      "The survey has no marks measured by total station. Nothing independent says how far "
                      "the terrain model is from the ground."),
    QT_TRANSLATE_NOOP("Report", "No check mark could be compared with the product."),
    QT_TRANSLATE_NOOP("Report", "The check marks' own error is not known: the RMSE_V found leaves it out."),
    QT_TRANSLATE_NOOP("Report",
                      "no run stood on a mark that it was not tied to, so nothing tells its error in plan"),
    QT_TRANSLATE_NOOP("Report", "the surface has no slope at the marks"),
    QT_TRANSLATE_NOOP("Report", "the heights have no error"),
    QT_TRANSLATE_NOOP(
        "Report",
        "Whether the check marks stand among plants or in the open is not known: the points were not looked "
        "through for what stands on the ground, or too few lie near the marks."),
    QT_TRANSLATE_NOOP("Report", "no GNSS: raw positions are the start and the velocity summed up from there"),
    QT_TRANSLATE_NOOP(
        "Report", "no known mark to zero the barometer on: it is tied to the median GNSS height of the run"),
    QT_TRANSLATE_NOOP("Report", "no barometer in use: GNSS height is used whatever the fix"),
    QT_TRANSLATE_NOOP("Report", "GNSS height of any fix stands in there"),
    QT_TRANSLATE_NOOP("Report", "nothing measures height there, the walk is taken to climb little"),
    QT_TRANSLATE_NOOP("Report", "nothing in the log measures height: it is held near that of the start"),
    QT_TRANSLATE_NOOP("Report",
                      "the adjustment of all runs has no solution: the tracks are those of the filter, "
                      "crossovers are not used"),
    QT_TRANSLATE_NOOP("Report", "the scale of the optical flow wanders: the adjustment follows it"),
    QT_TRANSLATE_NOOP("Report", "adjusting all runs anew: the scale of the optical flow wanders"),
    QT_TRANSLATE_NOOP("Report", "it walks straight, but no mark lies near its end"),
    QT_TRANSLATE_NOOP("Report", "it has no positions"),
    QT_TRANSLATE_NOOP("Report", "as told"),
    QT_TRANSLATE_NOOP("Report", "no log has positions: say where the zero point is"),
    QT_TRANSLATE_NOOP("Report", "it is a second table of marks"),
    QT_TRANSLATE_NOOP("Report", "it is a trajectory, no log of the array"),
    QT_TRANSLATE_NOOP("Report", "it is neither a log of the array nor a table of marks"),
    QT_TRANSLATE_NOOP("Report", "testing on parts left out"),
    QT_TRANSLATE_NOOP("Report", "tuning"),
    QT_TRANSLATE_NOOP("Report",
                      "The search found nothing better than the values that it started from; these stay."),
    QT_TRANSLATE_NOOP("Report",
                      "There is one part only, so nothing can be left out to test the tuned values on: the "
                      "default is not replaced by them."),
};
constexpr const char* kSentences[] = {
    QT_TRANSLATE_NOOP("Report", "%1, best loss %2"),
    QT_TRANSLATE_NOOP("Report", "looking at the effect of %1"),
    QT_TRANSLATE_NOOP("Report", "The tuned values hold out better than those before: %1."),
    QT_TRANSLATE_NOOP("Report",
                      "The tuned values do not hold out better than those before: %1. `process --tune` does "
                      "not adopt them."),
    QT_TRANSLATE_NOOP("Report",
                      "on parts left out of the tuning the loss goes from %1 to %2, a gain of %3 with a "
                      "standard error of %4"),
    QT_TRANSLATE_NOOP("Report", "reading %1"),
    QT_TRANSLATE_NOOP("Report", "writing %1"),
    QT_TRANSLATE_NOOP("Report", "fusing %1"),
    QT_TRANSLATE_NOOP("Report", "smoothing %1"),
    QT_TRANSLATE_NOOP("Report", "fused %1"),
    QT_TRANSLATE_NOOP("Report", "Height error of %1 (RMSE)"),
    QT_TRANSLATE_NOOP("Report", "at %1"),
    QT_TRANSLATE_NOOP("Report", "%1 check marks"),
    QT_TRANSLATE_NOOP("Report", "%1 check mark"),
    QT_TRANSLATE_NOOP("Report", "%1 control marks"),
    QT_TRANSLATE_NOOP("Report", "%1 control mark"),
    QT_TRANSLATE_NOOP("Report", "%1 marks"),
    QT_TRANSLATE_NOOP("Report", "%1 mark"),
    QT_TRANSLATE_NOOP("Report", "%1 comparisons"),
    QT_TRANSLATE_NOOP("Report", "%1 comparison"),
    QT_TRANSLATE_NOOP("Report", "at %1; %2 before fusion and %3 now at the %4 that both reach"),
    QT_TRANSLATE_NOOP("Report", "at %1; %2 before fusion"),
    QT_TRANSLATE_NOOP("Report", "at %1; sensors as they are"),
    QT_TRANSLATE_NOOP("Report", "of %1 measured"),
    QT_TRANSLATE_NOOP("Report", "of %1 measured; %2 beside them"),
    QT_TRANSLATE_NOOP("Report", "none was measured; %1 beside them"),
    QT_TRANSLATE_NOOP("Report", "%1 m cells"),
    QT_TRANSLATE_NOOP("Report", "%1 triangulated; %2 ground points"),
    QT_TRANSLATE_NOOP("Report",
                      "Heights of %1 differ from %2 by %3 (vertical RMSE; 95 % interval %4 to %5). With the "
                      "marks' own error of %6 it is %7."),
    QT_TRANSLATE_NOOP("Report",
                      "Heights of %1 differ from %2 by %3 (vertical RMSE; 95 % interval %4 to %5)."),
    QT_TRANSLATE_NOOP(
        "Report",
        "Heights of %1 differ from %2 by %3 (vertical RMSE). With the marks' own error of %4 it is %5."),
    QT_TRANSLATE_NOOP("Report", "Heights of %1 differ from %2 by %3 (vertical RMSE)."),
    QT_TRANSLATE_NOOP("Report",
                      "Tested with %1 check marks, at least the %2 that the ASPRS Positional Accuracy "
                      "Standards, Edition 2, ask for. No accuracy class is claimed: that takes a class to "
                      "test against and check marks on open ground."),
    QT_TRANSLATE_NOOP("Report",
                      "Tested using the reduced number of %1. The ASPRS Positional Accuracy Standards, "
                      "Edition 2, ask for %2; with fewer, no accuracy class can be claimed."),
    QT_TRANSLATE_NOOP("Report",
                      "Tested %1 vertical accuracy at 95 % confidence level (NSSDA, FGDC-STD-007.3-1998: "
                      "1.9600 times the RMSE of %2)."),
    QT_TRANSLATE_NOOP(
        "Report",
        "By the formula of the NSSDA (FGDC-STD-007.3-1998) it would be %1 vertical accuracy at 95 % "
        "confidence level (1.9600 times the RMSE of %2), but the NSSDA asks for %3 and more."),
    QT_TRANSLATE_NOOP("Report",
                      "Errors in plan turn into errors of height on slopes: the %1 along an axis seen at the "
                      "stands, times the slope at %2, is %3 (RMSE), %4 % of the mean square height error."),
    QT_TRANSLATE_NOOP("Report",
                      "Before fusion the height RMSE was %1 (%2); at the same %3 it is %4 now, %5 % less."),
    QT_TRANSLATE_NOOP("Report",
                      "Before fusion the height RMSE was %1 (%2); at the same %3 it is %4 now, %5 % more."),
    QT_TRANSLATE_NOOP("Report", "Before fusion the height RMSE was %1 (%2); at the same %3 it is %4 now."),
    QT_TRANSLATE_NOOP("Report",
                      "%1 of %2 heights (%3 %) lie within 1.96 predicted sigmas; 95 % would be right. The "
                      "mean square of error over sigma is %4; 1 would be right."),
    QT_TRANSLATE_NOOP("Report",
                      "%1 of %2 heights (%3 %) lie within 1.96 predicted sigmas; 95 % would be right. The "
                      "mean square of error over sigma is %4; 1 would be right, but so few decide little."),
    QT_TRANSLATE_NOOP("Report",
                      "The heights lie %1 on average (%2): more than chance explains. Look for a wrong array "
                      "height, a wrong start mark or a shifted datum."),
    QT_TRANSLATE_NOOP(
        "Report",
        "%1 is off by %2, more than %3 times the RMSE of the others: a possible blunder. It is counted."),
    QT_TRANSLATE_NOOP("Report",
                      "This data set was tested to meet ASPRS Positional Accuracy Standards for Digital "
                      "Geospatial Data, Edition 2, Version 2 (2024) for a %1 cm RMSE_V Vertical Accuracy "
                      "Class. The Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = %2 cm."),
    QT_TRANSLATE_NOOP(
        "Report",
        "This data set was tested as required by ASPRS Positional Accuracy Standards for Digital Geospatial "
        "Data, Edition 2, Version 2 (2024) and does not meet the %1 cm RMSE_V Vertical Accuracy Class asked "
        "for. The Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = %2 cm."),
    QT_TRANSLATE_NOOP("Report",
                      "This data set was not tested as required by ASPRS Positional Accuracy Standards for "
                      "Digital Geospatial Data, Edition 2, Version 2 (2024): the check marks' own error of "
                      "%1 cm is more than half of the %2 cm RMSE_V Vertical Accuracy Class asked for. The "
                      "Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = %3 cm."),
    QT_TRANSLATE_NOOP(
        "Report",
        "This data set was tested as required by ASPRS Positional Accuracy Standards for Digital Geospatial "
        "Data, Edition 2, Version 2 (2024). Although the Standards call for a minimum of thirty (30) "
        "checkpoints, this test was performed using ONLY %1 checkpoints. The Non-Vegetated Vertical Accuracy "
        "(NVA) was found to be RMSE_V = %2 cm using the reduced number of checkpoints, within the %3 cm "
        "RMSE_V Vertical Accuracy Class asked for."),
    QT_TRANSLATE_NOOP(
        "Report",
        "This data set was tested as required by ASPRS Positional Accuracy Standards for Digital Geospatial "
        "Data, Edition 2, Version 2 (2024). Although the Standards call for a minimum of thirty (30) "
        "checkpoints, this test was performed using ONLY %1 checkpoints. The Non-Vegetated Vertical Accuracy "
        "(NVA) was found to be RMSE_V = %2 cm using the reduced number of checkpoints, beyond the %3 cm "
        "RMSE_V Vertical Accuracy Class asked for."),
    QT_TRANSLATE_NOOP("Report",
                      "The Vegetated Vertical Accuracy (VVA) was found to be RMSE_V = %1 cm at %2."),
    QT_TRANSLATE_NOOP("Report",
                      "The mean error of %1 is more than a quarter of the RMSE_V asked for: the ASPRS "
                      "standards want its cause found."),
    QT_TRANSLATE_NOOP(
        "Report",
        "%1 is off by %2, more than %3 times the RMSE_V asked for: a possible blunder. It is counted."),
    QT_TRANSLATE_NOOP("Report", "What errors in plan add to errors of height on slopes is not known: %1."),
    QT_TRANSLATE_NOOP("Report", "%1 lies outside the surface and could not be compared: %2."),
    QT_TRANSLATE_NOOP("Report", "%1 lie outside the surface and could not be compared: %2."),
    QT_TRANSLATE_NOOP("Report", "%1 has no ground point near enough and could not be compared: %2."),
    QT_TRANSLATE_NOOP("Report", "%1 have no ground point near enough and could not be compared: %2."),
    QT_TRANSLATE_NOOP("Report", "%1 was stood on without a sound range and could not be compared: %2."),
    QT_TRANSLATE_NOOP("Report", "%1 were stood on without a sound range and could not be compared: %2."),
    QT_TRANSLATE_NOOP("Report",
                      "No check mark was compared. %1 stand in the report apart; errors at marks that may "
                      "have served alignment or tuning do not certify the product."),
    QT_TRANSLATE_NOOP(
        "Report",
        "No check mark was compared, and none of the %1 tells an error that the estimator has not seen."),
    QT_TRANSLATE_NOOP("Report",
                      "Standing on %1, the fused position was off by %2 in plan (RMSE). By the NSSDA that is "
                      "%3 at 95 % confidence."),
    QT_TRANSLATE_NOOP("Report", "Standing on %1, the fused position was off by %2 in plan (RMSE)."),
    QT_TRANSLATE_NOOP("Report",
                      "%1 is a small sample: the true error may differ a good deal from the figure found."),
    QT_TRANSLATE_NOOP("Report",
                      "%1 are a small sample: the true error may differ a good deal from the figure found."),
    QT_TRANSLATE_NOOP(
        "Report",
        "The estimator was tied to the mark or tuned on it in %1; these are listed and never counted."),
    QT_TRANSLATE_NOOP("Report", "Before fusion there is no surface to compare with: %1."),
    QT_TRANSLATE_NOOP("Report", "The heights have no standard errors: %1."),
    QT_TRANSLATE_NOOP("Report", "The heights have no standard errors, and there is no multiband file: %1."),
    QT_TRANSLATE_NOOP("Report", "Run %1 has no records for %2 s: the track there is a guess."),
    QT_TRANSLATE_NOOP("Report", "Left out by hand: %1 of run %2 from %3 to %4 s."),
    QT_TRANSLATE_NOOP("Report", "Left out by hand: run %1."),
    QT_TRANSLATE_NOOP("Report", "Left out by hand: mark %1."),
    QT_TRANSLATE_NOOP("Report", "Drawn by hand: %1 lines of the surface."),
    QT_TRANSLATE_NOOP("Report", "tuning without %1"),
    QT_TRANSLATE_NOOP("Report", "%1 (runs %2)"),
    QT_TRANSLATE_NOOP("Report", "no epoch while the array stood on %1"),
    QT_TRANSLATE_NOOP("Report",
                      "no range while the array stood on %1: its height above the mark is taken to be %2 m"),
    QT_TRANSLATE_NOOP("Report", "the barometer was silent on the marks: it is zeroed %1 s away from one"),
    QT_TRANSLATE_NOOP("Report", "the barometer was silent for up to %1 s: %2"),
    QT_TRANSLATE_NOOP("Report", "it walks straight and ends %1 m by GNSS from %2"),
    QT_TRANSLATE_NOOP("Report", "its name says %1"),
    QT_TRANSLATE_NOOP(
        "Report",
        "variance of the method: noise times %1, structure times %2, learnt from %3 points left "
        "out"),
    QT_TRANSLATE_NOOP("Report",
                      "terrace edges found but not kept to: %1; method %2, which cannot follow them, "
                      "foretells points left out better than those that do"),
    QT_TRANSLATE_NOOP("Report", "%1; %2 ground points left out, %3 of them below the ground"),
    QT_TRANSLATE_NOOP("Report", "%1 m3 free, %2 m3 occupied, in voxels of %3 m about %4 %5 %6"),
    QT_TRANSLATE_NOOP("Report", "right above the ground in %1 of %2 cells (%3 %), there to %4 m (median)"),
    QT_TRANSLATE_NOOP("Report", "above the ground in %1 cells (%2 %)"),
    QT_TRANSLATE_NOOP("Report", "not determined with %1 marks"),
    QT_TRANSLATE_NOOP("Report", "not determined with %1 mark"),
    QT_TRANSLATE_NOOP("Report", "terrace edges are not looked for: method %1 cannot follow them"),
    QT_TRANSLATE_NOOP("Report", "terrace edges are not looked for among more than %1 points"),
    QT_TRANSLATE_NOOP("Report", "it walks %1 m within %2 m"),
    QT_TRANSLATE_NOOP("Report",
                      "zero point: mean GNSS position of the ground where %1 of %2 walks start, %3 m apart "
                      "at most; say where it is if you know it better"),
    QT_TRANSLATE_NOOP("Report", "%1 is passed over: %2"),
};

}  // namespace

QString reportWords(std::string_view words) {
    // These are for the tool alone.
    static_cast<void>(kWords);
    static_cast<void>(kSentences);
    static_cast<void>(kErrorWords);
    static_cast<void>(kErrorSentences);
    static_cast<void>(kPageWords);
    return QString::fromStdString(reportLanguage() == ReportLanguage::Chinese ? inChinese(words)
                                                                              : std::string(words));
}

QString errorWords(const Error& error) {
    QString words = reportWords(printable(error.message));
    if (!error.cure.empty())
        words =
            QCoreApplication::translate("Report", "%1; %2").arg(words, reportWords(printable(error.cure)));
    if (error.file.empty()) return words;
    QString where = QString::fromStdString(printable(error.file.string()));
    if (error.line > 0) where += QString(":%1").arg(error.line);
    return QCoreApplication::translate("Report", "%1: %2").arg(where, words);
}

}  // namespace terrawalk::gui
