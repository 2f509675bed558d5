#pragma once

#include <QColor>
#include <QCoreApplication>
#include <QString>
#include <array>

#include "survey/array_log.hpp"

namespace terrawalk::gui {

/// A kind of GNSS fix as maps and plots name it.
struct FixClass {
    int code;
    const char* name;  ///< to be translated in the context "FixClass"
    QRgb colour;

    [[nodiscard]] QString words() const { return QCoreApplication::translate("FixClass", name); }
};

/// Best first. Colours of Okabe and Ito: told apart by readers who do not see all colours.
inline constexpr std::array<FixClass, 5> kFixClasses{{
    {fix_code::kRtkFixed, QT_TRANSLATE_NOOP("FixClass", "RTK fixed"), qRgb(0, 158, 115)},
    {fix_code::kRtkFloat, QT_TRANSLATE_NOOP("FixClass", "RTK float"), qRgb(86, 180, 233)},
    {fix_code::kDifferential, QT_TRANSLATE_NOOP("FixClass", "DGNSS"), qRgb(240, 228, 66)},
    {fix_code::kSingle, QT_TRANSLATE_NOOP("FixClass", "single"), qRgb(230, 159, 0)},
    {fix_code::kNone, QT_TRANSLATE_NOOP("FixClass", "none"), qRgb(213, 94, 0)},
}};

}  // namespace terrawalk::gui
