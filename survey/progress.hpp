#pragma once

#include <string>
#include <string_view>

namespace terrawalk {

enum class Severity { Info, Warning };

/// How long work tells of itself. Libraries never print; they report here.
/// Implementations are called from any thread, possibly at once, and return quickly.
class Progress {
  public:
    virtual ~Progress() = default;
    /// @param fraction  0..1 of the work that this object stands for
    /// @param step      what is being done, a short phrase such as "fusing F03"
    virtual void report(double fraction, std::string_view step) = 0;
    virtual void message(Severity severity, std::string_view text) = 0;
};

class SilentProgress final : public Progress {
  public:
    void report(double, std::string_view) override {}
    void message(Severity, std::string_view) override {}
};

/// A part of a longer job: maps 0..1 to [begin, end] of the parent. Must not outlive the parent.
class PartialProgress final : public Progress {
  public:
    PartialProgress(Progress& parent, double begin, double end) : parent_(parent), begin_(begin), end_(end) {}
    void report(double fraction, std::string_view step) override {
        parent_.report(begin_ + fraction * (end_ - begin_), step);
    }
    void message(Severity severity, std::string_view text) override { parent_.message(severity, text); }

  private:
    Progress& parent_;
    double begin_;
    double end_;
};

}  // namespace terrawalk
