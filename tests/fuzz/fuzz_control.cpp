// Whatever the bytes: no crash, and marks that are accepted have a name and finite numbers.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include "io/read_survey.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrawalk;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto table = parseControlMarks(bytes, "fuzz.csv");
    if (!table) {
        if (table.error().text().empty()) std::abort();
        return 0;
    }
    std::set<std::string> names;
    for (const ControlMark& mark : table->marks) {
        const bool good = !mark.name.empty() && mark.name != kZeroMark && names.insert(mark.name).second &&
                          mark.enu_m.allFinite() && mark.sigma_h_m >= 0.0 && mark.sigma_v_m >= 0.0 &&
                          std::isfinite(mark.sigma_h_m) && std::isfinite(mark.sigma_v_m);
        if (!good) std::abort();
    }
    return 0;
}
