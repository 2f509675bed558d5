#include "app/pipeline/tune_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/output_folder.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kFormat = "terrawalk-tune-checkpoint 1";
constexpr std::chrono::seconds kBetweenWrites{5};

/// Infinity has no JSON number.
ordered_json lossesJson(const std::vector<double>& losses) {
    ordered_json list = ordered_json::array();
    for (const double loss : losses) list.push_back(std::isfinite(loss) ? ordered_json(loss) : nullptr);
    return list;
}

std::vector<double> lossesOf(const json& list) {
    std::vector<double> losses;
    for (const json& loss : list) {
        losses.push_back(loss.is_null() ? std::numeric_limits<double>::infinity() : loss.get<double>());
    }
    return losses;
}

TuneRecord recordOf(const json& searches) {
    TuneRecord record;
    for (const json& search : searches) {
        EvaluationRecord& one = record.emplace_back();
        one.fingerprint = search.at("fingerprint").get<std::uint64_t>();
        for (const json& island : search.at("islands")) one.islands.push_back(lossesOf(island));
    }
    return record;
}

Result<void> checkedIdentity(const json& document, const TuneIdentity& wanted, const fs::path& file) {
    const auto other = [&](const std::string& what) {
        return badData("the checkpoint is of another " + what, file, 0,
                       "start without --resume, with another --checkpoint file");
    };
    if (document.at("program") != wanted.program) {
        return other("program, " + document.at("program").get<std::string>());
    }
    if (document.at("survey") != wanted.survey) return other("survey, or its logs have changed");
    if (document.at("configuration") != wanted.configuration) return other("configuration");
    if (document.at("search") != wanted.search) {
        return other("search: " + document.at("search").get<std::string>() + "; asked for: " + wanted.search);
    }
    return {};
}

}  // namespace

TuneCheckpoint::TuneCheckpoint(fs::path file, TuneIdentity identity)
    : file_(std::move(file)),
      identity_(std::move(identity)),
      last_written_(std::chrono::steady_clock::now()) {}

Result<TuneCheckpoint> TuneCheckpoint::begin(fs::path file, TuneIdentity identity) {
    std::error_code error;
    if (fs::exists(file, error)) {
        return usageError(fmt::format("{} holds the losses of an interrupted tuning", file.string()),
                          "continue it with --resume, or remove the file");
    }
    return TuneCheckpoint(std::move(file), std::move(identity));
}

Result<TuneCheckpoint> TuneCheckpoint::resume(fs::path file, TuneIdentity identity) {
    std::ifstream stream(file, std::ios::binary);
    std::error_code error;
    if (!stream || !fs::is_regular_file(file, error)) {
        return badData("there is no checkpoint to resume from", file, 0, "start without --resume");
    }
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    TuneCheckpoint checkpoint(std::move(file), std::move(identity));
    try {
        const json document = json::parse(text);
        if (document.at("format") != kFormat) {
            return badData("is no checkpoint of a tuning", checkpoint.file_, 0, "check the path");
        }
        if (auto good = checkedIdentity(document, checkpoint.identity_, checkpoint.file_); !good) {
            return tl::unexpected(good.error());
        }
        checkpoint.read_ = recordOf(document.at("searches"));
    } catch (const json::exception&) {
        return badData("the checkpoint is damaged", checkpoint.file_, 0,
                       "remove it and start without --resume");
    }
    checkpoint.record_ = checkpoint.read_;
    return checkpoint;
}

bool TuneCheckpoint::isEmpty() const {
    return std::all_of(record_.begin(), record_.end(), [](const EvaluationRecord& search) {
        return std::all_of(search.islands.begin(), search.islands.end(),
                           [](const std::vector<double>& losses) { return losses.empty(); });
    });
}

void TuneCheckpoint::onSearch(std::size_t search, std::uint64_t fingerprint) {
    if (record_.size() <= search) record_.resize(search + 1);
    record_[search].fingerprint = fingerprint;
}

void TuneCheckpoint::onLosses(std::size_t search, std::size_t island, std::span<const double> losses) {
    auto& islands = record_[search].islands;
    if (islands.size() <= island) islands.resize(island + 1);
    islands[island].insert(islands[island].end(), losses.begin(), losses.end());
    const auto now = std::chrono::steady_clock::now();
    if (now - last_written_ < kBetweenWrites) return;
    // A disk that is full now may have room at the end; the last write tells.
    (void)write();
    last_written_ = std::chrono::steady_clock::now();
}

std::string TuneCheckpoint::text() const {
    ordered_json searches = ordered_json::array();
    for (const EvaluationRecord& search : record_) {
        ordered_json islands = ordered_json::array();
        for (const auto& losses : search.islands) islands.push_back(lossesJson(losses));
        searches.push_back({{"fingerprint", search.fingerprint}, {"islands", std::move(islands)}});
    }
    const ordered_json document{{"format", kFormat},          {"program", identity_.program},
                                {"survey", identity_.survey}, {"configuration", identity_.configuration},
                                {"search", identity_.search}, {"searches", std::move(searches)}};
    return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Result<void> TuneCheckpoint::write() {
    return writeTextFile(text(), file_);
}

void TuneCheckpoint::remove() {
    std::error_code ignored;
    fs::remove(file_, ignored);
}

}  // namespace terrawalk
