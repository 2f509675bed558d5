#include "app/gui/sample_surveys.hpp"

#include <QCoreApplication>
#include <QDir>
#include <algorithm>
#include <utility>

namespace terrawalk::gui {

std::vector<SampleSurvey> sampleSurveys() {
    const QDir beside(QCoreApplication::applicationDirPath() + "/../share/terrawalk/sample_surveys");
    const QDir folder = beside.exists() ? beside : QDir(TERRAWALK_SAMPLE_SURVEYS);
    const std::pair<const char*, QString> known[] = {
        {"quick_plot", QCoreApplication::translate("terrawalk::gui::StartPage",
                                                   "Quick plot: a small one, done in a second")},
        {"mango_orchard", QCoreApplication::translate("terrawalk::gui::StartPage",
                                                      "Mango orchard: terraces, plants, poor GNSS")}};
    std::vector<SampleSurvey> found;
    for (const auto& [name, title] : known) {
        if (folder.exists(QString(name) + "/survey.json")) {
            found.push_back({title, folder.filePath(name).toStdString()});
        }
    }
    return found;
}

bool isSample(const std::filesystem::path& project_file) {
    const auto samples = sampleSurveys();
    std::error_code error;
    return std::any_of(samples.begin(), samples.end(), [&](const SampleSurvey& sample) {
        return std::filesystem::equivalent(sample.path, project_file.parent_path(), error);
    });
}

}  // namespace terrawalk::gui
