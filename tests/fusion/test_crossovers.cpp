#include "fusion/crossovers.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>
#include <vector>

#include "tests/support/random_numbers.hpp"

namespace terrawalk {
namespace {

using Terrain = std::function<double(const Eigen::Vector2d&)>;

constexpr double kInterval_s = 0.2;

double level(const Eigen::Vector2d&) {
    return 0.0;
}

double plane(const Eigen::Vector2d& en_m) {
    return 0.3 * en_m.x() - 0.2 * en_m.y();
}

/// Walks a straight line at 1 m/s and hits the ground, `raised_m` too high.
void walk(std::vector<GroundSample>& samples, std::uint32_t run, double start_s, const Eigen::Vector2d& from,
          const Eigen::Vector2d& to, const Terrain& terrain, double raised_m = 0.0) {
    const auto steps = static_cast<int>((to - from).norm() / kInterval_s);
    for (int k = 0; k <= steps; ++k) {
        const Eigen::Vector2d en_m = from + kInterval_s * k * (to - from).normalized();
        samples.push_back({run, static_cast<std::uint32_t>(samples.size()), start_s + kInterval_s * k,
                           Eigen::Vector3d(en_m.x(), en_m.y(), terrain(en_m) + raised_m)});
    }
}

/// Three walks that turn at random in a small field, in curves wide enough that they leave a place before
/// they come back to it. Passes meet at all angles.
std::vector<GroundSample> tangle(std::uint64_t seed) {
    constexpr double kField_m = 12.0;
    test::RandomNumbers random(seed);
    std::vector<GroundSample> samples;
    for (std::uint32_t run = 0; run < 3; ++run) {
        Eigen::Vector2d at(random.uniform(0.0, kField_m), random.uniform(0.0, kField_m));
        double course = random.uniform(0.0, 6.28);
        for (std::uint32_t i = 0; i < 400; ++i) {
            const bool inside = at.minCoeff() > 0.0 && at.maxCoeff() < kField_m;
            course += inside ? random.uniform(-0.08, 0.08) : 0.1;
            at += 0.2 * Eigen::Vector2d(std::cos(course), std::sin(course));
            if (random.uniform(0.0, 1.0) < 0.1) continue;  // no range
            samples.push_back({run, i, kInterval_s * i,
                               Eigen::Vector3d(at.x(), at.y(), plane(at) + 0.02 * random.normal())});
        }
    }
    return samples;
}

using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

std::multiset<Pair> pairsOf(const std::vector<Crossover>& crossovers) {
    std::multiset<Pair> pairs;
    for (const Crossover& c : crossovers) pairs.insert({c.run_a, c.epoch_a, c.run_b, c.epoch_b});
    return pairs;
}

// Splits where the run changes or where nothing was near for more than 4 s.
std::vector<std::vector<std::size_t>> stretches(const std::vector<GroundSample>& samples,
                                                const Eigen::Vector2d& place_m, double radius_m) {
    std::vector<std::vector<std::size_t>> found;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if ((samples[k].enu_m.head<2>() - place_m).norm() > radius_m) continue;
        const bool goes_on = !found.empty() && samples[found.back().back()].run == samples[k].run &&
                             samples[k].time_s - samples[found.back().back()].time_s <= 4.0;
        if (!goes_on) found.emplace_back();
        found.back().push_back(k);
    }
    return found;
}

// By comparing every place with every sample.
std::multiset<Pair> bruteForce(const std::vector<GroundSample>& samples, const CrossoverOptions& options) {
    std::multiset<Pair> pairs;
    std::size_t before = samples.size();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (before < samples.size() && samples[before].run == samples[i].run &&
            (samples[i].enu_m - samples[before].enu_m).head<2>().norm() < options.spacing_m) {
            continue;
        }
        before = i;
        const Eigen::Vector2d here_m = samples[i].enu_m.head<2>();
        for (const std::vector<std::size_t>& other : stretches(samples, here_m, options.gate_m)) {
            const std::size_t j =
                *std::min_element(other.begin(), other.end(), [&](std::size_t a, std::size_t b) {
                    return (samples[a].enu_m.head<2>() - here_m).norm() <
                           (samples[b].enu_m.head<2>() - here_m).norm();
                });
            if (j <= i) continue;
            if (samples[j].run == samples[i].run && samples[j].time_s - samples[i].time_s < options.apart_s)
                continue;
            const Eigen::Vector2d middle_m = 0.5 * (here_m + samples[j].enu_m.head<2>());
            std::size_t enough = 0;
            for (const auto& ground : stretches(samples, middle_m, options.radius_m)) {
                const bool of_the_pair = std::count(ground.begin(), ground.end(), i) > 0 ||
                                         std::count(ground.begin(), ground.end(), j) > 0;
                if (of_the_pair && ground.size() >= options.fewest_points) ++enough;
            }
            if (enough == 2) {
                pairs.insert({samples[i].run, samples[i].epoch, samples[j].run, samples[j].epoch});
            }
        }
    }
    return pairs;
}

TEST(Crossovers, AreThoseOfAComparisonOfAllWithAll) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        for (const double gate_m : {0.4, 1.0}) {
            CrossoverOptions options;
            options.gate_m = gate_m;
            const std::vector<GroundSample> samples = tangle(seed);
            const std::multiset<Pair> expected = bruteForce(samples, options);
            EXPECT_GT(expected.size(), 20U);
            EXPECT_EQ(pairsOf(findCrossovers(samples, options)), expected) << seed << ' ' << gate_m;
        }
    }
}

TEST(Crossovers, KeepToTheirOptions) {
    const CrossoverOptions options;
    const std::vector<GroundSample> samples = tangle(6);
    const std::vector<Crossover> crossovers = findCrossovers(samples, options);
    ASSERT_GT(crossovers.size(), 50U);
    bool within_a_run = false;
    for (const Crossover& c : crossovers) {
        EXPECT_LE(c.apart_m, options.gate_m);
        EXPECT_GE(c.points, static_cast<double>(options.fewest_points));
        EXPECT_LE(c.run_a, c.run_b);
        if (c.run_a != c.run_b) continue;
        within_a_run = true;
        EXPECT_GE(kInterval_s * (c.epoch_b - c.epoch_a), options.apart_s - 1e-9);
    }
    EXPECT_TRUE(within_a_run);
}

TEST(Crossovers, LieASpacingApartAlongAPass) {
    std::vector<GroundSample> samples;
    walk(samples, 0, 0.0, {0.0, 0.0}, {20.0, 0.0}, level);
    walk(samples, 1, 0.0, {0.0, 0.3}, {20.0, 0.3}, level);
    CrossoverOptions options;
    options.spacing_m = 0.7;
    const std::vector<Crossover> crossovers = findCrossovers(samples, options);
    // Samples lie 0.2 m apart, so places 0.8 m: 0 to 20 m hold 26. All lie on the earlier pass.
    EXPECT_EQ(crossovers.size(), 26U);
    for (std::size_t k = 0; k < crossovers.size(); ++k) {
        EXPECT_EQ(crossovers[k].run_a, 0U);
        EXPECT_EQ(crossovers[k].epoch_a, 4 * k);
        EXPECT_NEAR(crossovers[k].place_m.x(), 0.8 * static_cast<double>(k), 1e-9);
        EXPECT_NEAR(crossovers[k].place_m.y(), 0.15, 1e-9);
    }
}

TEST(Crossovers, ThereAreNoneWherePassesDoNotMeet) {
    std::vector<GroundSample> samples;
    walk(samples, 0, 0.0, {0.0, 0.0}, {20.0, 0.0}, level);
    walk(samples, 0, 30.0, {20.0, 1.1}, {0.0, 1.1}, level);
    walk(samples, 1, 0.0, {0.0, -1.1}, {20.0, -1.1}, level);
    EXPECT_TRUE(findCrossovers(samples, {}).empty());
    EXPECT_TRUE(findCrossovers({}, {}).empty());
}

TEST(Crossovers, APassDoesNotMeetItself) {
    std::vector<GroundSample> samples;
    walk(samples, 0, 0.0, {0.0, 0.0}, {9.0, 0.0}, level);
    walk(samples, 0, 9.2, {9.0, 0.4}, {0.0, 0.4}, level);
    // 19 s of walk: it passes its own start earlier than `apart_s` allows.
    EXPECT_TRUE(findCrossovers(samples, {}).empty());
    CrossoverOptions sooner;
    sooner.apart_s = 10.0;
    const std::vector<Crossover> crossovers = findCrossovers(samples, sooner);
    EXPECT_FALSE(crossovers.empty());
    for (const Crossover& c : crossovers) {
        EXPECT_GE(samples[c.epoch_b].time_s - samples[c.epoch_a].time_s, 10.0);
    }
}

// Loiters out of the gate and back in within the radius of the fit: one stretch of samples, not two passes.
TEST(Crossovers, TwoPlacesOfOneStretchAreNone) {
    std::vector<GroundSample> samples;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const double angle = 2.0 * std::acos(-1.0) * i / 150.0;  // once around in 30 s
        samples.push_back({0, i, kInterval_s * i,
                           Eigen::Vector3d(0.45 * std::cos(angle), 0.45 * std::sin(angle), 0.001 * i)});
    }
    CrossoverOptions options;
    options.gate_m = 0.3;
    EXPECT_TRUE(findCrossovers(samples, options).empty());
}

// Both passes see one plane; without the ridge that holds its slope back the fit is exact.
TEST(Crossovers, TellThePlaneAndByHowMuchPassesDiffer) {
    std::vector<GroundSample> samples;
    walk(samples, 0, 0.0, {-5.0, 0.0}, {5.0, 0.0}, plane);
    walk(samples, 1, 0.0, {0.1, -5.0}, {0.1, 5.0}, plane, 0.07);
    CrossoverOptions options;
    options.ridge_m2 = 1e-12;
    const std::vector<Crossover> crossovers = findCrossovers(samples, options);
    ASSERT_FALSE(crossovers.empty());
    for (const Crossover& c : crossovers) {
        EXPECT_NEAR(c.misfit_m, -0.07, 1e-9);
        EXPECT_LT((c.slope - Eigen::Vector2d(0.3, -0.2)).norm(), 1e-9);
        EXPECT_LT(c.roughness_m, 1e-6);
    }
}

TEST(Crossovers, ARidgeOnlyHoldsTheSlopeBack) {
    std::vector<GroundSample> samples;
    walk(samples, 0, 0.0, {-5.0, 0.0}, {5.0, 0.0}, plane);
    walk(samples, 1, 0.0, {0.0, -5.0}, {0.0, 5.0}, plane, 0.07);
    for (const Crossover& c : findCrossovers(samples, {})) {
        EXPECT_LT(c.slope.norm(), Eigen::Vector2d(0.3, -0.2).norm());
        EXPECT_GT(c.slope.norm(), 0.5 * Eigen::Vector2d(0.3, -0.2).norm());
    }
    std::vector<GroundSample> even;
    walk(even, 0, 0.0, {-5.0, 0.0}, {5.0, 0.0}, level);
    walk(even, 1, 0.0, {0.0, -5.0}, {0.0, 5.0}, level, 0.07);
    // Nothing to hold back.
    for (const Crossover& c : findCrossovers(even, {})) EXPECT_NEAR(c.misfit_m, -0.07, 1e-12);
}

TEST(Crossovers, DoNotDependOnWhereTheOriginLies) {
    const std::vector<GroundSample> samples = tangle(7);
    std::vector<GroundSample> moved = samples;
    const Eigen::Vector3d shift(-1234.567, 987.654, 321.0);
    for (GroundSample& sample : moved) sample.enu_m += shift;
    const std::vector<Crossover> here = findCrossovers(samples, {});
    const std::vector<Crossover> there = findCrossovers(moved, {});
    ASSERT_EQ(here.size(), there.size());
    // Heights of 300 m round to 6e-14; the normal matrix with its ridge of 0.1 loses three digits at most.
    for (std::size_t k = 0; k < here.size(); ++k) {
        EXPECT_EQ(here[k].epoch_a, there[k].epoch_a);
        EXPECT_EQ(here[k].epoch_b, there[k].epoch_b);
        EXPECT_NEAR(here[k].misfit_m, there[k].misfit_m, 1e-9);
    }
}

TEST(Crossovers, AreTheSameEachTime) {
    const std::vector<GroundSample> samples = tangle(8);
    const std::vector<Crossover> first = findCrossovers(samples, {});
    const std::vector<Crossover> second = findCrossovers(samples, {});
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
        EXPECT_EQ(first[k].epoch_a, second[k].epoch_a);
        EXPECT_EQ(first[k].epoch_b, second[k].epoch_b);
        EXPECT_EQ(first[k].misfit_m, second[k].misfit_m);
        EXPECT_EQ(first[k].roughness_m, second[k].roughness_m);
    }
}

// A pass is ten hits within the radius: as a plain mean one hit 0.6 m too high would be up to 0.06 m.
TEST(Crossovers, AHitOnAPlantCountsLittle) {
    std::vector<GroundSample> samples;
    walk(samples, 0, 0.0, {-5.0, 0.0}, {5.0, 0.0}, level);
    walk(samples, 1, 0.0, {0.0, -5.0}, {0.0, 5.0}, level);
    const auto at = std::find_if(samples.begin(), samples.end(), [](const GroundSample& s) {
        return s.run == 1 && std::abs(s.enu_m.y() - 0.2) < 0.05;
    });
    ASSERT_NE(at, samples.end());
    at->enu_m.z() += 0.6;
    double worst = 0.0;
    for (const Crossover& c : findCrossovers(samples, {})) worst = std::max(worst, std::abs(c.misfit_m));
    EXPECT_GT(worst, 0.0);
    EXPECT_LT(worst, 0.03);
}

TEST(MarkPasses, TellTheHeightOfEachPassOverTheMark) {
    const Eigen::Vector3d mark_enu_m(1.0, 0.2, plane({1.0, 0.2}));
    std::vector<GroundSample> samples;
    walk(samples, 0, 0.0, {-5.0, 0.0}, {5.0, 0.0}, plane, 0.05);
    walk(samples, 0, 40.0, {1.0, 5.0}, {1.0, -5.0}, plane, -0.03);
    walk(samples, 1, 0.0, {-5.0, 1.4}, {5.0, 1.4}, plane, 9.0);  // 1.2 m away
    CrossoverOptions options;
    options.ridge_m2 = 1e-6;  // shrinks slopes by some 1e-6 of their size
    const std::vector<MarkPass> passes = findMarkPasses(samples, mark_enu_m, options);
    ASSERT_EQ(passes.size(), 2U);
    EXPECT_NEAR(passes[1].misfit_m, -0.03, 1e-5);
    EXPECT_NEAR(passes[1].apart_m, 0.0, 1e-9);
    // The pass lies 0.2 m aside; the slope across its way is 0.2 and stays unknown.
    EXPECT_NEAR(passes[0].misfit_m, 0.05 + 0.2 * 0.2, 1e-5);
    EXPECT_NEAR(passes[0].apart_m, 0.2, 1e-9);
    EXPECT_EQ(passes[0].run, 0U);
}

TEST(MarkPasses, NeedEnoughPoints) {
    std::vector<GroundSample> samples;
    walk(samples, 0, 0.0, {0.7, 0.0}, {5.0, 0.0}, level);  // two samples within 1 m
    EXPECT_TRUE(findMarkPasses(samples, Eigen::Vector3d::Zero(), {}).empty());
    CrossoverOptions options;
    options.fewest_points = 2;
    EXPECT_EQ(findMarkPasses(samples, Eigen::Vector3d::Zero(), options).size(), 1U);
}

}  // namespace
}  // namespace terrawalk
