#include "mapping/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>
#include <tuple>
#include <utility>

#include "mapping/order_statistics.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kResamples = 4000;
constexpr std::size_t kRobustResamples = 1000;  // of them, for what takes sorting
constexpr std::size_t kLeastMarksForInterval = 5;
constexpr double kNormalMad = 1.4826;  // NMAD of a normal distribution is its sigma

/// Steele, Lea and Flood 2014; standard generators differ between libraries in what they make of a seed.
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
    /// An index below n; n must be below 2^32.
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(((next() >> 32U) * n) >> 32U); }

  private:
    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31U);
    }
    std::uint64_t state_;
};

/// The differences at one mark.
using MarkSample = std::vector<double>;

double rms(const std::vector<double>& values) {
    double squares = 0.0;
    for (const double value : values) squares += value * value;
    return std::sqrt(squares / static_cast<double>(values.size()));
}

double nmadAbout(const std::vector<double>& d, double median_m) {
    std::vector<double> from_median(d.size());
    std::transform(d.begin(), d.end(), from_median.begin(),
                   [&](double value) { return std::abs(value - median_m); });
    return kNormalMad * median(std::move(from_median));
}

std::vector<double> sortedMagnitudes(const std::vector<double>& d) {
    std::vector<double> magnitudes(d.size());
    std::transform(d.begin(), d.end(), magnitudes.begin(), [](double value) { return std::abs(value); });
    std::sort(magnitudes.begin(), magnitudes.end());
    return magnitudes;
}

ConfidenceInterval middle95(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {quantileOfSorted(values, 0.025), quantileOfSorted(values, 0.975)};
}

/// Of the 95 % quantile of sorted sizes, by order statistics. Differences at one mark count as one, as if
/// each mark had as many: of n differences at m marks the places among m are stretched by n over m.
std::optional<ConfidenceInterval> quantileInterval95(const std::vector<double>& sorted, std::size_t marks) {
    const auto places = quantilePlaces95(marks, 0.95);
    if (!places) return std::nullopt;
    const std::size_t low = places->low * sorted.size() / marks;
    const std::size_t high = ((places->high + 1) * sorted.size() + marks - 1) / marks - 1;
    return ConfidenceInterval{sorted[low], sorted[high]};
}

void addIntervals(const std::vector<MarkSample>& marks, std::uint64_t seed, ErrorStatistics& s) {
    if (marks.size() < kLeastMarksForInterval) return;
    SplitMix64 random(seed);
    std::vector<double> rmse, medians, nmads;
    std::vector<double> drawn;
    for (std::size_t resample = 0; resample < kResamples; ++resample) {
        drawn.clear();
        for (std::size_t i = 0; i < marks.size(); ++i) {
            const MarkSample& mark = marks[random.below(marks.size())];
            drawn.insert(drawn.end(), mark.begin(), mark.end());
        }
        rmse.push_back(rms(drawn));
        if (resample >= kRobustResamples) continue;
        medians.push_back(median(drawn));
        nmads.push_back(nmadAbout(drawn, medians.back()));
    }
    s.rmse_95 = middle95(std::move(rmse));
    s.median_95 = middle95(std::move(medians));
    s.nmad_95 = middle95(std::move(nmads));
}

ErrorStatistics statistics(const std::vector<double>& d, const std::vector<MarkSample>& marks,
                           std::uint64_t seed) {
    assert(!d.empty());
    const auto n = static_cast<double>(d.size());
    ErrorStatistics s;
    s.n = d.size();
    s.marks = marks.size();
    s.mean_m = std::accumulate(d.begin(), d.end(), 0.0) / n;
    double deviations = 0.0, magnitudes = 0.0;
    for (const double value : d) {
        deviations += (value - s.mean_m) * (value - s.mean_m);
        magnitudes += std::abs(value);
    }
    s.rmse_m = rms(d);
    if (d.size() >= 2) s.sd_m = std::sqrt(deviations / (n - 1.0));
    s.mae_m = magnitudes / n;
    s.median_m = median(d);
    s.nmad_m = nmadAbout(d, s.median_m);
    const std::vector<double> sorted = sortedMagnitudes(d);
    s.error68_m = quantileOfSorted(sorted, 0.683);
    s.error95_m = quantileOfSorted(sorted, 0.95);
    s.largest_m =
        *std::max_element(d.begin(), d.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    addIntervals(marks, seed, s);
    s.error95_95 = quantileInterval95(sorted, marks.size());
    return s;
}

template <class Value>
std::optional<ErrorStatistics> ofAxis(const std::vector<const Residual*>& residuals, std::uint64_t seed,
                                      Value value) {
    std::vector<MarkDifference> differences;
    for (const Residual* residual : residuals) {
        const double d = value(residual->difference_enu_m);
        if (std::isfinite(d)) differences.push_back({residual->mark, d});
    }
    if (differences.empty()) return std::nullopt;
    return errorStatistics(differences, seed);
}

bool isOfSurface(const Residual& residual) {
    return residual.stage == Stage::Surface && residual.quantity == Quantity::SurfaceHeight;
}

std::optional<SigmaCoverage> heightCoverage(const std::vector<const Residual*>& residuals) {
    SigmaCoverage coverage;
    for (const Residual* residual : residuals) {
        const double d = residual->difference_enu_m.z(), sigma = residual->sigma_enu_m.z();
        if (!std::isfinite(d) || !std::isfinite(sigma)) continue;
        coverage.add(d, sigma);
    }
    if (coverage.n == 0) return std::nullopt;
    return coverage;
}

}  // namespace

ErrorStatistics errorStatistics(const std::vector<double>& differences_m, std::uint64_t seed) {
    std::vector<MarkSample> marks;
    marks.reserve(differences_m.size());
    for (const double d : differences_m) marks.push_back({d});
    return statistics(differences_m, marks, seed);
}

ErrorStatistics errorStatistics(const std::vector<MarkDifference>& differences, std::uint64_t seed) {
    std::vector<double> d;
    std::vector<MarkSample> marks;
    std::map<std::string, std::size_t> index_of_mark;
    for (const auto& [mark, difference_m] : differences) {
        d.push_back(difference_m);
        const auto [at, is_new] = index_of_mark.try_emplace(mark, marks.size());
        if (is_new) marks.emplace_back();
        marks[at->second].push_back(difference_m);
    }
    return statistics(d, marks, seed);
}

std::vector<AccuracyGroup> accuracyGroups(const std::vector<Residual>& residuals, std::uint64_t seed) {
    constexpr std::array kStages{Stage::BeforeFusion, Stage::Fused, Stage::Surface};
    constexpr std::array kQuantities{Quantity::ArrayPosition, Quantity::NearestSample,
                                     Quantity::SurfaceHeight};
    constexpr std::array kRoles{MarkRole::Check, MarkRole::Control};

    std::vector<AccuracyGroup> groups;
    for (const Stage stage : kStages) {
        for (const Quantity quantity : kQuantities) {
            for (const MarkRole role : kRoles) {
                std::vector<const Residual*> members;
                for (const Residual& r : residuals) {
                    if (r.stage == stage && r.quantity == quantity && r.role == role &&
                        !r.used_by_estimator) {
                        members.push_back(&r);
                    }
                }
                AccuracyGroup group;
                group.stage = stage;
                group.quantity = quantity;
                group.role = role;
                using Vector = Eigen::Vector3d;
                group.east = ofAxis(members, seed, [](const Vector& d) { return d.x(); });
                group.north = ofAxis(members, seed, [](const Vector& d) { return d.y(); });
                group.up = ofAxis(members, seed, [](const Vector& d) { return d.z(); });
                group.horizontal = ofAxis(
                    members, seed, [](const Vector& d) { return std::sqrt(d.x() * d.x() + d.y() * d.y()); });
                group.up_coverage = heightCoverage(members);
                if (group.up) group.nssda_vertical_m = nssdaVertical_m(group.up->rmse_m);
                if (group.east && group.north) {
                    group.nssda_horizontal_m = nssdaHorizontal_m(group.east->rmse_m, group.north->rmse_m);
                }
                if (group.east || group.north || group.up) groups.push_back(std::move(group));
            }
        }
    }
    return groups;
}

double nssdaVertical_m(double rmse_z_m) {
    return 1.9600 * rmse_z_m;
}

std::optional<double> nssdaHorizontal_m(double rmse_x_m, double rmse_y_m) {
    constexpr double kLeastRatio = 0.6, kSame = 1e-9;
    const double low = std::min(rmse_x_m, rmse_y_m), high = std::max(rmse_x_m, rmse_y_m);
    if (low >= (1.0 - kSame) * high) return 1.7308 * std::hypot(rmse_x_m, rmse_y_m);
    if (low >= kLeastRatio * high) return 2.4477 * 0.5 * (rmse_x_m + rmse_y_m);
    return std::nullopt;
}

bool countsIn(const Residual& residual, const AccuracyGroup& group) {
    return residual.stage == group.stage && residual.quantity == group.quantity &&
           residual.role == group.role && !residual.used_by_estimator &&
           std::isfinite(residual.difference_enu_m.z());
}

std::vector<AccuracyStratum> accuracyStrata(const std::vector<Residual>& residuals,
                                            const AccuracyGroup& group, std::uint64_t seed) {
    constexpr double kTreadSlope = 0.10, kRiserSlope = 0.30;
    std::vector<AccuracyStratum> strata;
    const auto add = [&](std::string name, auto belongs) {
        std::vector<MarkDifference> differences;
        for (const Residual& r : residuals) {
            if (countsIn(r, group) && belongs(r)) differences.push_back({r.mark, r.difference_enu_m.z()});
        }
        if (!differences.empty()) strata.push_back({std::move(name), errorStatistics(differences, seed)});
    };
    add("tread, slope below 10 %", [](const Residual& r) { return r.slope < kTreadSlope; });
    add("slope of 10 to 30 %",
        [](const Residual& r) { return r.slope >= kTreadSlope && r.slope < kRiserSlope; });
    add("riser, slope of 30 % and more", [](const Residual& r) { return r.slope >= kRiserSlope; });
    add("open", [](const Residual& r) { return r.cover == GroundCover::Open; });
    add("vegetated", [](const Residual& r) { return r.cover == GroundCover::Vegetated; });
    return strata;
}

tl::expected<SlopeLeakage, std::string> slopeLeakage(const std::vector<Residual>& residuals,
                                                     const std::vector<AccuracyGroup>& groups,
                                                     const AccuracyGroup& group) {
    const AccuracyGroup* stands = nullptr;
    for (const AccuracyGroup& g : groups) {  // check marks come before control marks
        if (g.stage == Stage::Fused && g.quantity == Quantity::ArrayPosition && g.east && g.north) {
            stands = &g;
            break;
        }
    }
    if (stands == nullptr) {
        return tl::unexpected<std::string>(
            "no run stood on a mark that it was not tied to, so nothing tells its error in plan");
    }
    SlopeLeakage leakage;
    leakage.plan_rmse_m = std::hypot(stands->east->rmse_m, stands->north->rmse_m) / std::sqrt(2.0);
    double leaked = 0.0, observed = 0.0;
    for (const Residual& r : residuals) {
        if (!countsIn(r, group) || !std::isfinite(r.slope)) continue;
        ++leakage.n;
        leaked += std::pow(leakage.plan_rmse_m * r.slope, 2.0);
        observed += r.difference_enu_m.z() * r.difference_enu_m.z();
    }
    if (leakage.n == 0) return tl::unexpected<std::string>("the surface has no slope at the marks");
    if (observed <= 0.0) return tl::unexpected<std::string>("the heights have no error");
    leakage.rmse_m = std::sqrt(leaked / static_cast<double>(leakage.n));
    leakage.share = leaked / observed;
    return leakage;
}

std::vector<Residual> withBlundersFlagged(std::vector<Residual> residuals, double vertical_class_m) {
    constexpr std::size_t kLeastForBlunders = 5;
    struct Squares {
        double sum = 0.0;
        std::size_t n = 0;
    };
    std::map<std::tuple<Stage, Quantity, MarkRole>, Squares> groups;
    const auto counts = [](const Residual& r) {
        return !r.used_by_estimator && std::isfinite(r.difference_enu_m.z());
    };
    for (const Residual& r : residuals) {
        if (!counts(r)) continue;
        Squares& squares = groups[{r.stage, r.quantity, r.role}];
        squares.sum += r.difference_enu_m.z() * r.difference_enu_m.z();
        ++squares.n;
    }
    for (Residual& r : residuals) {
        r.possible_blunder = false;
        if (!counts(r)) continue;
        if (vertical_class_m > 0.0 && isOfSurface(r)) {
            r.possible_blunder = std::abs(r.difference_enu_m.z()) > kBlunderMultiple * vertical_class_m;
            continue;
        }
        const Squares& squares = groups.at({r.stage, r.quantity, r.role});
        if (squares.n < kLeastForBlunders) continue;
        const double square = r.difference_enu_m.z() * r.difference_enu_m.z();
        const double others = std::max(0.0, squares.sum - square) / static_cast<double>(squares.n - 1);
        r.possible_blunder = square > kBlunderMultiple * kBlunderMultiple * others;
    }
    return residuals;
}

std::optional<VerticalClassTest> verticalClassTest(const std::vector<Residual>& residuals,
                                                   const std::vector<ControlMark>& marks,
                                                   const AccuracyGroup& group, double vertical_class_m) {
    constexpr double kGreatestShareOfMarks = 0.5;  // sections 7.9 and 7.12
    if (!(vertical_class_m > 0.0) || group.stage != Stage::Surface ||
        group.quantity != Quantity::SurfaceHeight || group.role != MarkRole::Check) {
        return std::nullopt;
    }
    std::map<std::string_view, double> sigmas_m;
    for (const ControlMark& mark : marks) sigmas_m[mark.name] = mark.sigma_v_m;
    struct Sum {
        std::size_t n = 0;
        double fit = 0.0, of_marks = 0.0;
        [[nodiscard]] double root(double sum) const { return std::sqrt(sum / static_cast<double>(n)); }
        [[nodiscard]] double rmse() const { return rmseWithMarkError_m(root(fit), root(of_marks)); }
    } open, vegetated;
    for (const Residual& r : residuals) {
        if (!countsIn(r, group)) continue;
        const auto sigma_m = sigmas_m.find(r.mark);
        Sum& sum = r.cover == GroundCover::Vegetated ? vegetated : open;
        ++sum.n;
        sum.fit += std::pow(r.difference_enu_m.z(), 2.0);
        sum.of_marks += sigma_m == sigmas_m.end() ? 0.0 : std::pow(sigma_m->second, 2.0);
    }
    if (open.n == 0) return std::nullopt;
    VerticalClassTest test;
    test.class_m = vertical_class_m;
    test.marks = open.n;
    test.rmse_v_m = open.rmse();
    test.mark_sigma_m = open.root(open.of_marks);
    test.vegetated_marks = vegetated.n;
    if (vegetated.n > 0) test.vegetated_rmse_v_m = vegetated.rmse();
    test.enough_marks = open.n >= kAsprsCheckMarks;
    test.marks_sure = test.mark_sigma_m <= kGreatestShareOfMarks * vertical_class_m;
    test.within = test.rmse_v_m <= vertical_class_m;
    return test;
}

double rmseWithMarkError_m(double rmse_fit_m, double sigma_marks_m) {
    return std::sqrt(rmse_fit_m * rmse_fit_m + sigma_marks_m * sigma_marks_m);
}

}  // namespace terrawalk
