#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "survey/ground_point.hpp"
#include "survey/relief_image.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

struct ConfidenceInterval {
    double low_m = 0.0;
    double high_m = 0.0;
};

/// Error measures of n differences d = product - mark [m].
/// Source: RMSE, mean, SD as in the ASPRS Positional Accuracy Standards, Edition 2; median, NMAD and the
/// quantiles of |d| as in Hoehle and Hoehle 2009. SD needs n >= 2 and is absent below.
struct ErrorStatistics {
    std::size_t n = 0;
    std::size_t marks = 0;  ///< different marks among the n; fewer than n where runs met on a mark
    double mean_m = 0.0;
    std::optional<double> sd_m;
    double rmse_m = 0.0;
    double mae_m = 0.0;
    double median_m = 0.0;
    double nmad_m = 0.0;
    double error68_m = 0.0;  ///< 68.3 % of the |d| are below
    double error95_m = 0.0;  ///< 95 % are
    double largest_m = 0.0;  ///< the difference of greatest magnitude, with its sign
    /// 95 % intervals by bootstrap over the marks, seeded; they need 5 marks.
    std::optional<ConfidenceInterval> rmse_95, median_95, nmad_95;
    /// By order statistics, which need 72 marks.
    std::optional<ConfidenceInterval> error95_95;
};

enum class Stage {
    BeforeFusion,  ///< sensors as they are
    Fused,         ///< trajectory after fusion
    Surface,       ///< triangulated surface
};

/// What was compared with the mark.
enum class Quantity {
    ArrayPosition,  ///< mean ground position below the array while it stood on the mark
    NearestSample,  ///< height of the nearest ground point (the measure of the paper)
    SurfaceHeight,  ///< height of the triangulated surface at the mark
};

[[nodiscard]] std::string_view name(Stage stage);
[[nodiscard]] std::string_view name(Quantity quantity);

/// What grows at a mark, as far as the ground points tell.
enum class GroundCover {
    Unknown,    ///< points were not looked through for plants, or too few lie near
    Open,       ///< none near the mark is on a plant
    Vegetated,  ///< some are
};
[[nodiscard]] std::string_view name(GroundCover cover);

/// product - mark at one mark. Axes that were not measured are missing (NaN).
struct Residual {
    Stage stage = Stage::Fused;
    Quantity quantity = Quantity::SurfaceHeight;
    std::string mark;
    MarkRole role = MarkRole::Check;
    std::string run;  ///< run that stood on the mark; empty for the surface
    Eigen::Vector3d mark_enu_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d difference_enu_m = Eigen::Vector3d::Constant(kMissing);
    Eigen::Vector3d sigma_enu_m =
        Eigen::Vector3d::Constant(kMissing);  ///< predicted, mark's own sigma included
    /// The estimator was tied to this mark here, or tuned on it, so it certifies nothing.
    bool used_by_estimator = false;
    double slope = kMissing;  ///< of the surface at the mark, rise over run; missing without a surface
    GroundCover cover = GroundCover::Unknown;
    bool possible_blunder = false;  ///< stands out from its group; flagged and never left out
};

/// A comparison that was looked for and could not be made.
struct MissingResidual {
    Stage stage = Stage::Fused;
    Quantity quantity = Quantity::SurfaceHeight;
    std::string mark;
    MarkRole role = MarkRole::Check;
    std::string run;  ///< run that stood on the mark; empty but for the array's position
};

/// Statistics of one group of residuals. Horizontal is the length of (e, n): its mean, RMSE, MAE and median
/// are those of the distance, its SD and NMAD the spread of the distance, never negative.
struct AccuracyGroup {
    Stage stage = Stage::Fused;
    Quantity quantity = Quantity::SurfaceHeight;
    MarkRole role = MarkRole::Check;
    std::optional<ErrorStatistics> east, north, up, horizontal;
    std::optional<SigmaCoverage> up_coverage;  ///< heights with a predicted sigma
    /// Accuracy at 95 % confidence by the NSSDA (FGDC-STD-007.3-1998): vertical 1.9600 RMSE; horizontal from
    /// the RMSE of both axes, nothing where these are too unequal.
    std::optional<double> nssda_vertical_m, nssda_horizontal_m;
};

/// Heights of the headline group on one kind of ground.
struct AccuracyStratum {
    std::string name;  ///< e.g. "tread, slope below 10 %"
    ErrorStatistics up;
};

/// A test against a vertical accuracy class of the ASPRS Positional Accuracy Standards, Edition 2. RMSE_V
/// holds the marks' own error (section 7.11); marks among plants count apart, those of unknown cover as open
/// ground.
struct VerticalClassTest {
    double class_m = 0.0;       ///< RMSE_V that was asked for
    std::size_t marks = 0;      ///< check marks outside vegetation
    double rmse_v_m = 0.0;      ///< found at these
    double mark_sigma_m = 0.0;  ///< their own error, RMS; 0: not known
    std::size_t vegetated_marks = 0;
    double vegetated_rmse_v_m = 0.0;
    bool enough_marks = false;  ///< 30 and more
    bool marks_sure = false;    ///< their own error is not known, or no more than half of the class
    bool within = false;        ///< whether the RMSE_V is no more than the class
    /// Whether the data set may be said to be tested to meet the class.
    [[nodiscard]] bool met() const { return enough_marks && marks_sure && within; }
};

/// Part of the height error that errors in plan make on slopes: sigma_V^2 observed is about
/// sigma_V^2 + sigma_plan^2 slope^2.
struct SlopeLeakage {
    double plan_rmse_m = 0.0;  ///< along one axis, at the stands on marks
    double rmse_m = 0.0;       ///< of plan error times slope, over the headline group's marks
    double share = 0.0;        ///< of the group's mean square height error; may pass 1
    std::size_t n = 0;         ///< heights with a slope
};

/// One of the few figures that a reader looks for first, ready to print.
struct KeyFigure {
    std::string label;   ///< e.g. "Height error of the surface (RMSE)"
    std::string value;   ///< with its unit, e.g. "0.213 m", or "not known"
    std::string detail;  ///< e.g. "60 check marks; before fusion 0.612 m"
};

/// One parameter: what was asked for and what the program used.
struct UsedSetting {
    std::string key;
    std::string requested;  ///< "default" when the user said nothing
    std::string used;
};

struct InputFile {
    std::string path;  ///< relative to the project's folder
    std::size_t bytes = 0;
    std::string sha256;
};

struct CountedReason {
    std::string reason;
    std::size_t count = 0;
};

/// How many points each reason left out, in the order of GroundPointState; none that left out nothing. Pure.
[[nodiscard]] std::vector<CountedReason> leftOutByReason(const std::vector<GroundPoint>& points);

struct RunReport {
    std::string id;
    RunKind kind = RunKind::Area;
    std::size_t rows_read = 0;
    std::size_t epochs = 0;  ///< rows kept
    std::vector<std::size_t> repeated_lines;
    std::vector<std::size_t> late_lines;
    std::size_t cut_off_line = 0;
    double duration_s = 0.0;
    double distance_m = 0.0;  ///< length of the fused track
    std::size_t gaps = 0;     ///< steps between records of more than 2.5 usual ones
    double longest_gap_s = 0.0;
    std::vector<CountedReason> fixes;  ///< epochs by GNSS fix
    std::vector<SensorUse> sensors;
    std::size_t ground_points_used = 0;
    std::vector<CountedReason> ground_points_rejected;
    std::vector<std::string> notes;
    std::vector<Eigen::Vector3d> track_enu_m;  ///< thinned for drawing
};

/// Points foretold from the others, by one method in one way of leaving points out.
struct InterpolationScore {
    std::string method;    ///< as on the command line, e.g. "natural-neighbour"
    std::string hold_out;  ///< e.g. "spatial-blocks"
    std::size_t compared = 0;
    double rmse_m = 0.0;
    double mean_absolute_m = 0.0;
    double error95_m = 0.0;
};
/// Ways of interpolating compared on the survey's own points.
struct InterpolationComparison {
    std::vector<std::string> ranking;  ///< methods, best first
    std::vector<std::string> hold_outs;
    std::vector<InterpolationScore> scores;  ///< in that order of methods, and within it of hold-outs
    std::uint64_t seed = 0;
};

/// Terrace edges that were found in the points and that the surface keeps to.
struct TerraceEdgeSummary {
    std::size_t count = 0;
    double length_m = 0.0;
    double median_step_m = 0.0;            ///< height from toe to top edge
    double median_location_sigma_m = 0.0;  ///< of the edges' place, across
};

/// Standard errors of the heights of the grid.
struct UncertaintySummary {
    double median_m = 0.0;
    double error95_m = 0.0;                                        ///< 95 % of the cells have a smaller sigma
    std::size_t measured = 0, interpolated = 0, extrapolated = 0;  ///< cells, see CellSource
    /// Squared error of interpolation at distance d, where the places that far around differ in height by r
    /// (root mean square): c0 / 3 + c1 d + c2 d^2 + c3 r^2. Zeros where the method's own variance is used.
    std::array<double, 4> coefficients{};
    bool own_variance = false;         ///< whether the method's own variance is used, see the notes
    double at_point_m = 0.0;           ///< error of interpolation where a point lies, one sigma
    double greatest_distance_m = 0.0;  ///< from a point, of what the errors were learnt from
    double correlation_range_m =
        0.0;                 ///< over which errors hang together, for volumes; see SurfaceUncertainty
    SigmaCoverage left_out;  ///< the points left out against what they taught
};

/// How kriging takes heights to differ by their distance: a nugget, and a part that rises to the sill.
/// Lengths in the unit of the points.
struct VariogramSummary {
    std::string model;  ///< "power", "spherical", "exponential"
    double nugget_m2 = 0.0;
    double sill_m2 = 0.0;  ///< without the nugget; a power passes it at the range
    double range_m = 0.0;  ///< where a spherical one is at the sill, an exponential one at 95 % of it
    std::optional<double> exponent;  ///< of a power
    std::size_t pairs = 0;           ///< of points that its form comes from
};
/// @param unit  of the points, e.g. "m"
[[nodiscard]] std::string inWords(const VariogramSummary& variogram, std::string_view unit);

struct SurfaceReport {
    std::string method;            ///< in words
    std::string method_requested;  ///< as on the command line, or "auto"
    std::string method_used;
    std::optional<InterpolationComparison> comparison;
    std::size_t breaklines = 0;  ///< that were given
    TerraceEdgeSummary terrace_edges;
    std::optional<UncertaintySummary> uncertainty;
    std::optional<VariogramSummary> variogram;  ///< of kriging
    std::vector<std::string> notes;
    std::size_t points = 0;
    std::size_t triangles = 0;
    double longest_edge_m = 0.0;
    double area_m2 = 0.0;
    double cell_m = 0.0;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t cells_with_height = 0;
    double lowest_m = 0.0;
    double highest_m = 0.0;
    std::string crs;             ///< human-readable name of the map frame
    std::string vertical_datum;  ///< what the heights refer to
};

/// The space above the ground that the laser crossed.
struct OccupancySummary {
    double voxel_m = 0.0;
    double greatest_range_m = 0.0;
    double ground_layer_m = 0.0;                         ///< what lies lower above the DEM counts as ground
    double greatest_height_m = 0.0;                      ///< how far up was looked
    Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< map coordinates of the octree's zero
    std::size_t rays = 0;
    std::size_t left_out = 0;      ///< ground points without a sound range, position or epoch
    std::size_t below_ground = 0;  ///< of them hits below the DEM by more than the ground layer
    double free_m3 = 0.0;
    double occupied_m3 = 0.0;
    std::size_t ground_cells = 0;
    std::size_t cells_known_free = 0;   ///< with free space right above the ground layer
    double median_free_height_m = 0.0;  ///< of those cells
    std::size_t cells_with_obstacle = 0;
};
/// What all texts say of it, line by line: a word, and what is to be told.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> inWords(const OccupancySummary& summary);

/// How parameters of the fusion were tuned, where they were.
struct TuningRecord {
    std::string survey;   ///< whose marks were used
    std::string program;  ///< name and version
    std::string method;   ///< "aukf"
    std::string optimiser;
    std::uint64_t seed = 0;
    std::size_t population = 0;
    std::size_t iterations = 0;
    std::size_t evaluations = 0;  ///< in all, tests on parts left out among them
    std::string loss;             ///< what was made small, with its unit
    double loss_before = 0.0;
    double loss_after = 0.0;
    std::optional<double> left_out_before;  ///< the same on parts that were left out of the tuning
    std::optional<double> left_out_after;
    bool holds_out_better = false;
    bool in_use = true;    ///< whether the products were made with the tuned values
    std::string decision;  ///< one sentence: whether they are better on data that they have not seen
    std::vector<std::string> warnings;
    std::vector<ControlMark> marks;  ///< on which they were tuned: while in use, these certify nothing
};

/// Of report.html and report.pdf; the files for programs stay English.
enum class ReportLanguage { English, Chinese };

/// Everything that the report files say, in English; each writer shows the same values.
struct SurveyReport {
    ReportLanguage language = ReportLanguage::English;
    std::string survey_name;
    std::string program_version;
    std::string method;
    std::uint64_t seed = 0;
    std::vector<InputFile> inputs;
    std::vector<UsedSetting> settings;
    std::vector<RunReport> runs;
    std::optional<AdjustmentSummary> adjustment;  ///< of all runs, by method terrawalk
    SurfaceReport surface;
    std::optional<OccupancySummary> occupancy;  ///< where it was asked for
    std::optional<TuningRecord> tuning;
    std::optional<ReliefPicture> relief;  ///< of the surface, under the map; not part of report.json
    std::vector<ControlMark> marks;
    double vertical_class_m = 0.0;  ///< RMSE_V that the surface is to be tested for; 0: none
    std::vector<Residual> residuals;
    std::vector<MissingResidual> missing_residuals;
    std::vector<AccuracyGroup> accuracy;
    std::optional<std::size_t> headline;  ///< the group of `accuracy` that speaks for the product
    std::vector<AccuracyStratum>
        strata;  ///< of the headline group; none where slopes and cover are not known
    std::optional<SlopeLeakage> slope_leakage;
    std::string slope_leakage_unknown;  ///< why there is none, part of a sentence
    std::optional<VerticalClassTest> class_test;
    std::vector<KeyFigure> figures;
    std::vector<std::string> statements;   ///< what the marks say, in plain sentences
    std::vector<std::string> limitations;  ///< what could not be checked, in plain sentences
    std::vector<std::string> warnings;
};

}  // namespace terrawalk
