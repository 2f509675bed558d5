#pragma once

#include <string_view>

namespace terrawalk {

/// The look of the report page: an 8-pixel rhythm, colours that people with colour-blindness tell apart
/// (Okabe and Ito), light and dark by what the reader prefers, plain on paper. Holds none of < and &, so it
/// needs no escaping.
inline constexpr std::string_view kReportStyle = R"css(
:root {
    color-scheme: light dark;
    --page: #ffffff; --ink: #1c2126; --quiet: #59636e; --rule: #dde2e7; --panel: #f4f6f8; --accent: #006f52;
    --warn: #9a4b00; --warn-panel: #fff5e8;
    --before: #8a939c; --fused: #0072b2; --surface: #d55e00; --high: #d55e00; --low: #0072b2; --bar: #9fb8c9;
    --c0: #0072b2; --c1: #b85000; --c2: #007f5f; --c3: #a8507e; --c4: #9a7400; --c5: #3d8fc0;
}
@media (prefers-color-scheme: dark) {
    :root {
        --page: #14181c; --ink: #e6eaee; --quiet: #9aa5b0; --rule: #2d343b; --panel: #1d2328; --accent: #4cc9a0;
        --warn: #ffb866; --warn-panel: #2b2114;
        --before: #8d97a1; --fused: #56b4e9; --surface: #ff8c42; --high: #ff8c42; --low: #56b4e9; --bar: #41596b;
        --c0: #56b4e9; --c1: #ff8c42; --c2: #2fc79b; --c3: #e39ac1; --c4: #e0b13a; --c5: #86b6d6;
    }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body {
    margin: 0 auto; padding: 40px 24px 64px; max-width: 1040px; background: var(--page); color: var(--ink);
    font: 16px/24px system-ui, "Segoe UI", Roboto, "Helvetica Neue", "Liberation Sans", Arial, sans-serif;
}
h1 { margin: 0; font-size: 32px; line-height: 40px; letter-spacing: -0.01em; overflow-wrap: anywhere; }
h2 { margin: 56px 0 16px; font-size: 22px; line-height: 32px; }
h3 { margin: 32px 0 8px; font-size: 16px; line-height: 24px; }
p { margin: 0 0 8px; max-width: 72ch; }
ul { margin: 0; padding-left: 24px; }
li { margin: 0 0 8px; max-width: 76ch; overflow-wrap: anywhere; }
a { color: var(--accent); }
.lead { color: var(--quiet); margin: 0; }
nav { display: flex; flex-wrap: wrap; gap: 0 24px; margin: 16px 0 32px; padding: 8px 0; border-top: 1px solid var(--rule); border-bottom: 1px solid var(--rule); }
nav a { text-decoration: none; font-size: 14px; white-space: nowrap; }
nav a:hover { text-decoration: underline; }
.figures { display: grid; grid-template-columns: repeat(3, 1fr); gap: 16px; margin: 0 0 32px; }
.figure { padding: 16px 24px; background: var(--panel); border-top: 3px solid var(--accent); }
.figure.unknown { border-top-color: var(--warn); }
.figure b { display: block; font-size: 32px; line-height: 48px; letter-spacing: -0.01em; white-space: nowrap; }
.figure span { display: block; font-size: 14px; line-height: 24px; }
.figure .detail { color: var(--quiet); line-height: 20px; }
.limits { margin: 32px 0; padding: 16px 24px; background: var(--warn-panel); border-left: 4px solid var(--warn); }
.limits h2 { margin: 0 0 8px; color: var(--warn); }
.limits h3 { margin-top: 16px; }
.scroll { overflow-x: auto; margin: 0 0 8px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; line-height: 24px; }
caption { text-align: left; color: var(--quiet); padding: 0 0 8px; }
th, td { padding: 0 8px; text-align: left; vertical-align: baseline; border-bottom: 1px solid var(--rule); }
th:first-child, td:first-child { padding-left: 0; }
th:last-child, td:last-child { padding-right: 0; }
thead th { color: var(--quiet); font-weight: 600; vertical-align: bottom; line-height: 16px; padding-top: 8px; padding-bottom: 8px;
    border-bottom-color: var(--quiet); }
tbody th { font-weight: 600; }
tbody.group td:first-child { padding-left: 8px; }
tbody.group th .note { font-weight: 400; font-size: inherit; }
td.short { white-space: nowrap; }
tbody.group tr:first-child th, tbody.group tr:first-child td { border-top: 1px solid var(--quiet); }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
td.n { white-space: nowrap; }
td.key, td.hash { font-family: ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; font-size: 12px; }
td.key, td.text { overflow-wrap: anywhere; }
td.hash { word-break: break-all; }
tr.tied td { color: var(--quiet); }
tr.changed td { font-weight: 600; }
.total td, .total th { border-top: 1px solid var(--quiet); font-weight: 600; }
.note { color: var(--quiet); font-size: 14px; }
details { margin: 8px 0; }
summary { cursor: pointer; line-height: 32px; color: var(--accent); }
figure { margin: 0 0 24px; }
figcaption { color: var(--quiet); font-size: 14px; line-height: 20px; max-width: 84ch; margin-top: 4px; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(320px, 1fr)); gap: 32px; align-items: start; }
.runs { display: flex; flex-wrap: wrap; gap: 0 16px; list-style: none; padding: 0; margin: 4px 0 0; font-size: 13px; }
.runs li { display: flex; align-items: center; gap: 6px; margin: 0; }
.runs svg { width: 28px; height: 8px; }
footer { margin-top: 64px; padding-top: 16px; border-top: 1px solid var(--rule); color: var(--quiet); font-size: 14px; }
svg { display: block; width: 100%; height: auto; color: inherit; font-size: 12px; overflow: visible; }
svg text { fill: currentColor; }
svg .tick, svg .key { fill: var(--quiet); font-variant-numeric: tabular-nums; }
svg .label { font-size: 11px; paint-order: stroke; stroke: var(--page); stroke-width: 3px; stroke-linejoin: round; }
svg .grid, svg .ring { stroke: var(--rule); stroke-width: 1; fill: none; }
svg .frame { stroke: var(--quiet); stroke-width: 1; fill: none; }
svg .zero { stroke: var(--quiet); stroke-width: 1.5; }
svg .divide { stroke: var(--quiet); stroke-dasharray: 2 4; }
svg .ink { fill: currentColor; }
svg .mark { fill: currentColor; stroke: var(--page); stroke-width: 1; }
svg .high { fill: var(--high); }
svg .low { fill: var(--low); }
svg .bar { fill: var(--bar); }
svg .curve { fill: none; stroke: var(--surface); stroke-width: 2; }
svg .before { fill: var(--page); stroke: var(--before); stroke-width: 1.5; }
svg .fused { fill: var(--fused); stroke: var(--page); stroke-width: 0.75; }
svg .surface { fill: var(--surface); stroke: var(--page); stroke-width: 0.75; }
svg .track { fill: none; stroke-width: 1.5; stroke-linejoin: round; opacity: 0.75; }
svg .c0 { stroke: var(--c0); } svg .c1 { stroke: var(--c1); } svg .c2 { stroke: var(--c2); }
svg .c3 { stroke: var(--c3); } svg .c4 { stroke: var(--c4); } svg .c5 { stroke: var(--c5); }
svg .d1 { stroke-dasharray: 6 3; } svg .d2 { stroke-dasharray: 2 3; }
@media (max-width: 640px) {
    body { padding: 24px 16px 48px; }
    .figures { grid-template-columns: 1fr; }
    figure { overflow-x: auto; }
    figure > svg { min-width: 640px; }
    .pair figure > svg { min-width: 0; }
}
@media print {
    :root { color-scheme: light; --page: #ffffff; --ink: #000000; --quiet: #444444; --rule: #cccccc; --panel: #f4f4f4;
        --accent: #000000; --warn: #7a3b00; --warn-panel: #fff8ef; --before: #777777; --fused: #0072b2;
        --surface: #d55e00; --high: #d55e00; --low: #0072b2; --bar: #b8c8d4;
        --c0: #0072b2; --c1: #b85000; --c2: #007f5f; --c3: #a8507e; --c4: #9a7400; --c5: #3d8fc0; }
    @page { size: A4; margin: 16mm 14mm; }
    body { max-width: none; padding: 0; font-size: 10pt; line-height: 14pt; }
    table { font-size: 8pt; line-height: 12pt; }
    .note, figcaption, .figure span, .runs { font-size: 9pt; line-height: 12pt; }
    nav { display: none; }
    summary { list-style: none; color: inherit; font-weight: 600; break-after: avoid; }
    h2 { margin-top: 24pt; break-after: avoid; } h3 { break-after: avoid; }
    figure, .figure, .limits, tr { break-inside: avoid; }
    thead { display: table-header-group; }
    .scroll { overflow: visible; }
    details::details-content { content-visibility: visible; display: block; height: auto; }
    a { color: inherit; text-decoration: none; }
}
)css";

}  // namespace terrawalk
