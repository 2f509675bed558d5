#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stop_token>
#include <string_view>
#include <utility>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// How the track goes on while GNSS is masked.
enum class OutageMethod {
    Forward,           ///< fusion of the log up to the end of the outage: what is known at that moment
    Smoothed,          ///< fusion of the log with what follows the outage
    ConstantVelocity,  ///< the last Doppler velocity before the outage goes on
    IntegratedFlow,    ///< optical flow turned by the heading and summed up
};
inline constexpr std::array<std::pair<OutageMethod, std::string_view>, 4> kOutageMethodNames{
    {{OutageMethod::Forward, "forward"},
     {OutageMethod::Smoothed, "smoothed"},
     {OutageMethod::ConstantVelocity, "last velocity"},
     {OutageMethod::IntegratedFlow, "flow"}}};

struct OutageOptions {
    std::vector<double> lengths_s{10.0, 30.0, 60.0};
    double every_s = 5.0;      ///< from one outage's start to the next
    double history_s = 120.0;  ///< of the log before the outage, as far as there is so much
    double least_history_s = 20.0;
    double following_s = 120.0;  ///< after it, for Smoothed
    double longest_gap_s = 1.5;  ///< between Doppler velocities of the reference
};

/// One stretch of a run without GNSS position and velocity.
struct Outage {
    std::size_t run = 0;
    double start_s = 0.0;
    double length_s = 0.0;
    /// Horizontal distance between the displacement over the outage and that of the reference [m], by
    /// OutageMethod; infinite where fusion gave the log up.
    std::array<double, kOutageMethodNames.size()> error_m{};
    [[nodiscard]] double error(OutageMethod method) const {
        return error_m[static_cast<std::size_t>(method)];
    }
};

/// Masks GNSS in many stretches of a survey's logs, one at a time, and compares the displacement over each
/// with a reference: the truth where it is given, else the integral of the receiver's Doppler velocity over
/// the same stretch, which is itself in error by a metre or more. Each stretch is fused from its own piece of
/// the log, with neither marks nor stops outside the piece. Stretches without a reference are left out.
/// Works on as many threads as TBB allows; the result does not depend on their number.
/// Errors: BadData where no stretch has a reference; Cancelled.
/// @param truth  one trajectory for each run, one epoch for each row of its log; nullptr: none
[[nodiscard]] Result<std::vector<Outage>> measureOutages(const Survey& survey, const FusionOptions& fusion,
                                                         const OutageOptions& options,
                                                         const std::vector<Trajectory>* truth,
                                                         Progress& progress, std::stop_token stop);

/// Errors of one method over all outages of one length, rising.
[[nodiscard]] std::vector<double> outageErrors(const std::vector<Outage>& outages, double length_s,
                                               OutageMethod method);

}  // namespace terrawalk
