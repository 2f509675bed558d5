#include "app/pipeline/version.hpp"

namespace terrawalk {

std::string programVersion() {
    return "Terrawalk " TERRAWALK_VERSION;
}

std::string versionNumber() {
    return TERRAWALK_VERSION;
}

std::vector<std::pair<std::string, std::string>> libraryVersions() {
    return {{"CGAL", TERRAWALK_CGAL_VERSION},       {"Eigen", TERRAWALK_EIGEN_VERSION},
            {"GDAL", TERRAWALK_GDAL_VERSION},       {"GeographicLib", TERRAWALK_GEOGRAPHICLIB_VERSION},
            {"OctoMap", TERRAWALK_OCTOMAP_VERSION}, {"PCL", TERRAWALK_PCL_VERSION},
            {"PROJ", TERRAWALK_PROJ_VERSION}};
}

}  // namespace terrawalk
