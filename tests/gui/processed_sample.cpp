#include "tests/gui/processed_sample.hpp"

#include <QtGlobal>

#include "app/pipeline/jobs.hpp"

namespace terrawalk::test {

namespace {

template <class T>
T must(Result<T> result) {
    if (!result) qFatal("%s", result.error().text().c_str());
    return std::move(*result);
}

}  // namespace

ProcessedSample processedSample(const std::string& name) {
    SilentProgress silent;
    ProcessedSample sample;
    sample.survey = std::make_shared<const Survey>(
        must(openSurvey(std::filesystem::path(TERRAWALK_SOURCE_DIR) / "sample_surveys" / name, silent, {})));
    sample.products =
        std::make_shared<const Products>(must(process(*sample.survey, PipelineConfig{}, silent, {})));
    sample.map = std::make_shared<const SurveyMap>(must(fusedMap(*sample.survey, *sample.products, {})));
    return sample;
}

}  // namespace terrawalk::test
