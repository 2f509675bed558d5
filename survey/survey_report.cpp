#include "survey/survey_report.hpp"

namespace terrawalk {

std::string_view name(Stage stage) {
    switch (stage) {
        case Stage::BeforeFusion:
            return "before fusion";
        case Stage::Fused:
            return "fused";
        case Stage::Surface:
            return "surface";
    }
    return "";
}

std::string_view name(Quantity quantity) {
    switch (quantity) {
        case Quantity::ArrayPosition:
            return "position on mark";
        case Quantity::NearestSample:
            return "nearest ground point";
        case Quantity::SurfaceHeight:
            return "surface height";
    }
    return "";
}

}  // namespace terrawalk
