#pragma once

#include <QPolygonF>

#include "app/gui/plot_data.hpp"
#include "app/pipeline/survey_map.hpp"

namespace terrawalk::gui {

/// Heights along a line with their 95 % band, and the marks beside it. Pure.
/// @param line_m  map frame, at least two vertices
[[nodiscard]] Plot profilePlot(const Products& products, const SurveyMap& map, const QPolygonF& line_m);

}  // namespace terrawalk::gui
