#include "io/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>

#include "io/replacing_file.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr int kMostStagingFolders = 1000;
constexpr unsigned kRenameExchange = 1U << 1U;  // RENAME_EXCHANGE of linux/fs.h
constexpr std::array<std::string_view, 4> kSideFileSuffixes{".aux.xml", ".ovr", ".msk", ".tfw"};
constexpr std::string_view kOtherFolder = "choose another folder for the output";

tl::unexpected<Error> refused(const fs::path& target, const std::string& why) {
    return usageError("the output folder " + target.string() + " " + why, std::string(kOtherFolder));
}
tl::unexpected<Error> failed(const std::string& what, const fs::path& path, const std::error_code& error) {
    return systemError(what + ": " + error.message(), path);
}
std::error_code lastError() {
    return {errno, std::generic_category()};
}

// ---- What the target holds ----

enum class Content { Nothing, EmptyFolder, EarlierOutput };

struct Target {
    Content content = Content::Nothing;
    std::set<std::string> products;  ///< of an earlier output, manifest.json included
};

/// The products that a manifest lists; nothing when this is no manifest of ours.
std::optional<std::set<std::string>> productsOf(const fs::path& manifest, std::string_view format) {
    std::error_code unknown;
    if (!fs::is_regular_file(manifest, unknown)) return std::nullopt;
    std::ifstream stream(manifest, std::ios::binary);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (!json.is_object() || !json.contains("format") || json["format"] != format) return std::nullopt;
    if (!json.contains("products") || !json["products"].is_array()) return std::nullopt;
    std::set<std::string> products{std::string(kManifestName)};
    for (const auto& product : json["products"]) {
        if (!product.is_string()) return std::nullopt;
        products.insert(fs::path(product.get<std::string>()).lexically_normal().string());
    }
    return products;
}

/// In alphabetical order.
std::vector<std::string> namesIn(const fs::path& folder, std::error_code& error) {
    std::vector<std::string> names;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        names.push_back(it->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

Result<Target> inspect(const fs::path& target, std::string_view format) {
    std::error_code error;
    const fs::file_status status = fs::status(target, error);
    if (status.type() == fs::file_type::not_found) return Target{};
    if (status.type() == fs::file_type::none)
        return failed("cannot look at the output folder", target, error);
    if (status.type() != fs::file_type::directory) return refused(target, "is a file");
    const std::vector<std::string> names = namesIn(target, error);
    if (error) return failed("cannot read the output folder", target, error);
    if (names.empty()) return Target{Content::EmptyFolder, {}};
    if (auto products = productsOf(target / kManifestName, format)) {
        return Target{Content::EarlierOutput, std::move(*products)};
    }
    return refused(target,
                   fmt::format("holds something else than an earlier output: \"{}\"{}", names.front(),
                               names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : ""));
}

/// The real place of the target, without symbolic links and trailing slash.
Result<fs::path> resolved(const fs::path& target) {
    if (target.empty()) return usageError("the output folder has no name", std::string(kOtherFolder));
    std::error_code error;
    fs::path path = fs::absolute(target, error);
    if (error) return failed("cannot find the output folder", target, error);
    if (!path.has_filename()) path = path.parent_path();
    if (fs::is_symlink(fs::symlink_status(path, error)) && !fs::exists(path, error)) {
        return refused(target, "is a symbolic link that leads nowhere");
    }
    path = fs::weakly_canonical(path, error);
    if (error) return failed("cannot find the output folder", target, error);
    if (!path.has_filename()) path = path.parent_path();
    if (path == path.root_path()) return refused(target, "is the root of the file system");
    const fs::path here = fs::current_path(error);
    if (!error && std::mismatch(path.begin(), path.end(), here.begin(), here.end()).first == path.end()) {
        return refused(target, "is the current folder or one around it, which cannot be replaced");
    }
    struct stat folder {};
    struct stat parent {};
    if (::stat(path.c_str(), &folder) == 0 && ::stat(path.parent_path().c_str(), &parent) == 0 &&
        folder.st_dev != parent.st_dev) {
        return usageError(
            "the output folder " + target.string() + " is a mount point, which cannot be replaced",
            "choose a folder inside it");
    }
    return path;
}

/// Makes the folder and those above it; returns those made, innermost first.
Result<std::vector<fs::path>> makeFolders(const fs::path& folder) {
    std::vector<fs::path> missing;
    std::error_code error;
    for (fs::path path = folder; !fs::exists(path, error); path = path.parent_path()) {
        if (error) return failed("cannot look at the folder", path, error);
        missing.push_back(path);
    }
    fs::create_directories(folder, error);
    if (error) {
        for (const fs::path& path : missing) ::rmdir(path.c_str());
        return failed("cannot make the folder", folder, error);
    }
    return missing;
}

// ---- Locks ----

FileHandle openFolder(const fs::path& folder) {
    return FileHandle(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

/// Keeps runs with the same target apart while one of them looks at it or swaps it. Some network file systems
/// cannot lock folders; there the runs go on without, and never remove each other's staging folders.
FileHandle lockFolder(const fs::path& folder) {
    FileHandle handle = openFolder(folder);
    while (handle.isOpen() && ::flock(handle.get(), LOCK_EX) != 0 && errno == EINTR) {
    }
    return handle;
}

bool tryLock(const FileHandle& handle) {
    return handle.isOpen() && ::flock(handle.get(), LOCK_EX | LOCK_NB) == 0;
}

// ---- Folders beside the target ----

fs::path previousOf(const fs::path& target) {
    return target.parent_path() / fmt::format(".{}.previous", target.filename().string());
}
std::string stagingPrefix(const fs::path& target) {
    return fmt::format(".{}.partial-", target.filename().string());
}

bool isStagingName(const std::string& name, const std::string& prefix) {
    return name.size() > prefix.size() && name.starts_with(prefix) &&
           name.find_first_not_of("0123456789-", prefix.size()) == std::string::npos;
}

/// Removes what killed runs left: staging folders that nobody holds a lock on. What cannot be removed stays.
void removeDeadStaging(const fs::path& target) {
    const std::string prefix = stagingPrefix(target);
    std::error_code ignored;
    for (const std::string& name : namesIn(target.parent_path(), ignored)) {
        if (!isStagingName(name, prefix)) continue;
        const fs::path folder = target.parent_path() / name;
        const FileHandle handle = openFolder(folder);
        if (tryLock(handle)) fs::remove_all(folder, ignored);
    }
}

/// Finishes what a run killed between two renames began.
Result<void> recoverPrevious(const fs::path& target, std::string_view format) {
    const fs::path previous = previousOf(target);
    if (!productsOf(previous / kManifestName, format)) return {};
    std::error_code error;
    if (!fs::exists(target, error)) {
        fs::rename(previous, target, error);
        if (error) return failed("cannot put the previous output back", previous, error);
    } else {
        fs::remove_all(previous, error);
        if (error) return failed("cannot remove the remains of a previous output", previous, error);
    }
    return {};
}

// ---- Files of others ----

bool isSideFileOfProduct(const std::string& relative, const std::set<std::string>& products) {
    return std::any_of(kSideFileSuffixes.begin(), kSideFileSuffixes.end(), [&](std::string_view suffix) {
        if (!relative.ends_with(suffix)) return false;
        const std::string stem = relative.substr(0, relative.size() - suffix.size());
        // dem.tif.aux.xml stands beside dem.tif, and so does dem.tfw.
        return products.contains(stem) || products.contains(stem + ".tif");
    });
}

/// Such a folder is ours; it comes along only if it holds files of others.
bool holdsProducts(const fs::path& folder, const std::set<std::string>& products) {
    const auto first = products.lower_bound(folder.string() + "/");
    return first != products.end() && first->starts_with(folder.string() + "/");
}

Result<void> linkOrCopy(const fs::path& from, const fs::path& to) {
    if (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), 0) == 0) return {};
    std::error_code error;
    fs::copy(from, to, fs::copy_options::copy_symlinks, error);
    if (error) return failed("cannot carry a file over to the new output", from, error);
    return {};
}

enum class IfTaken { Refuse, Skip };

/// Brings the files in `from` that are no products of ours to `to`.
Result<void> carryOver(const fs::path& from, const fs::path& to, const std::set<std::string>& products,
                       IfTaken if_taken) {
    std::error_code error;
    for (fs::recursive_directory_iterator it(from, error), end; !error && it != end; it.increment(error)) {
        const fs::path relative = it->path().lexically_relative(from);
        if (products.contains(relative.string()) || isSideFileOfProduct(relative.string(), products))
            continue;
        const fs::path destination = to / relative;
        std::error_code problem;
        const fs::file_type there = fs::symlink_status(destination, problem).type();
        const bool is_folder = it->symlink_status(problem).type() == fs::file_type::directory;
        if (is_folder && (there == fs::file_type::directory || holdsProducts(relative, products))) continue;
        if (there != fs::file_type::not_found) {
            if (if_taken == IfTaken::Skip) continue;
            return refused(from, "holds \"" + relative.string() +
                                     "\", which is not Terrawalk's and would be replaced; move it away");
        }
        problem.clear();
        if (is_folder) {
            fs::create_directory(destination, it->path(), problem);
            if (problem) return failed("cannot make the folder", destination, problem);
            continue;
        }
        fs::create_directories(destination.parent_path(), problem);
        if (problem) return failed("cannot make the folder", destination.parent_path(), problem);
        if (auto carried = linkOrCopy(it->path(), destination); !carried) return carried;
    }
    if (error) return failed("cannot read the previous output", from, error);
    return {};
}

// ---- Disk ----

Result<void> syncToDisk(const fs::path& path) {
    const FileHandle handle(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!handle.isOpen()) return failed("cannot open", path, lastError());
    // Some file systems have nothing to sync for folders and say EINVAL.
    if (::fsync(handle.get()) != 0 && errno != EINVAL) return failed("cannot write", path, lastError());
    return {};
}

/// So that a power failure after the swap finds whole files behind the new name.
Result<void> syncTree(const fs::path& folder) {
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const fs::file_type type = it->symlink_status(error).type();
        if (type != fs::file_type::regular && type != fs::file_type::directory) continue;
        if (auto synced = syncToDisk(it->path()); !synced) return synced;
    }
    if (error) return failed("cannot read", folder, error);
    return syncToDisk(folder);
}

/// Swaps two folders, in one step where the file system can.
Result<void> swapFolders(const fs::path& staging, const fs::path& target) {
    if (::syscall(SYS_renameat2, AT_FDCWD, staging.c_str(), AT_FDCWD, target.c_str(), kRenameExchange) == 0)
        return {};
    const bool not_supported = errno == ENOSYS || errno == EINVAL || errno == ENOTSUP;
    if (!not_supported) return failed("cannot put the output in place", target, lastError());
    const fs::path previous = previousOf(target);
    std::error_code error;
    fs::rename(target, previous, error);
    if (error) return failed("cannot put the previous output aside", target, error);
    fs::rename(staging, target, error);
    if (error) {
        std::error_code ignored;
        fs::rename(previous, target, ignored);  // if this fails too, the next run does it
        return failed("cannot put the output in place", target, error);
    }
    // Under the name of a staging folder the next run removes it, should this one be killed now.
    fs::rename(previous, staging, error);
    if (error)
        return failed("the new output is in place, but the previous one cannot be renamed", previous, error);
    return {};
}

}  // namespace

Result<OutputFolder> OutputFolder::create(const fs::path& target, std::string_view format) {
    auto path = resolved(target);
    if (!path) return tl::unexpected(path.error());
    OutputFolder folder;
    folder.target_ = std::move(*path);
    folder.format_ = format;
    auto made = makeFolders(folder.target_.parent_path());
    if (!made) return tl::unexpected(made.error());
    folder.made_parents_ = std::move(*made);

    const FileHandle parent_lock = lockFolder(folder.target_.parent_path());
    if (auto recovered = recoverPrevious(folder.target_, format); !recovered)
        return tl::unexpected(recovered.error());
    if (auto content = inspect(folder.target_, format); !content) return tl::unexpected(content.error());
    removeDeadStaging(folder.target_);
    for (int attempt = 0; attempt < kMostStagingFolders; ++attempt) {
        const fs::path staging = folder.target_.parent_path() /
                                 fmt::format("{}{}-{}", stagingPrefix(folder.target_), ::getpid(), attempt);
        if (::mkdir(staging.c_str(), 0777) == 0) {
            folder.staging_ = staging;
            folder.lock_ = openFolder(staging);
            static_cast<void>(tryLock(folder.lock_));
            return folder;
        }
        if (errno != EEXIST) break;
    }
    return failed("cannot make the output folder", folder.target_, lastError());
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : target_(std::move(other.target_)),
      format_(std::move(other.format_)),
      staging_(std::exchange(other.staging_, {})),
      made_parents_(std::exchange(other.made_parents_, {})),
      lock_(std::move(other.lock_)) {}

OutputFolder& OutputFolder::operator=(OutputFolder&& other) noexcept {
    std::swap(target_, other.target_);
    std::swap(format_, other.format_);
    std::swap(staging_, other.staging_);
    std::swap(made_parents_, other.made_parents_);
    std::swap(lock_, other.lock_);
    return *this;
}

OutputFolder::~OutputFolder() {
    discard();
}

void OutputFolder::discard() noexcept {
    std::error_code ignored;
    if (!staging_.empty()) fs::remove_all(staging_, ignored);
    staging_.clear();
    for (const fs::path& parent : made_parents_) ::rmdir(parent.c_str());  // only if nobody put anything in
    made_parents_.clear();
}

Result<fs::path> OutputFolder::pathFor(const fs::path& relative) {
    const fs::path inside = relative.lexically_normal();
    if (!inside.has_filename() || inside.is_absolute() || *inside.begin() == ".." || inside == ".") {
        return usageError(
            fmt::format("\"{}\" is no name for a file in the output folder", relative.string()));
    }
    const fs::path path = staging_ / inside;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) return failed("cannot make the folder", path.parent_path(), error);
    return path;
}

Result<void> OutputFolder::commit() {
    // Outside the lock: the slow part.
    if (auto synced = syncTree(staging_); !synced) return synced;
    const FileHandle parent_lock = lockFolder(target_.parent_path());
    auto swapped = swapIn();
    if (swapped) {
        made_parents_.clear();
        static_cast<void>(lock_.close());
    }
    return swapped;
}

Result<void> OutputFolder::swapIn() {
    const auto target = inspect(target_, format_);
    if (!target) return tl::unexpected(target.error());
    std::error_code error;
    if (target->content != Content::Nothing) {
        const fs::perms mode = fs::status(target_, error).permissions();
        fs::permissions(staging_, mode, error);
        if (error) return failed("cannot set the permissions of the output", target_, error);
    }
    if (target->content != Content::EarlierOutput) {
        fs::rename(staging_, target_, error);  // takes the place of an empty folder
        if (error) return failed("cannot put the output in place", target_, error);
        staging_.clear();
        return syncToDisk(target_.parent_path());
    }

    if (auto carried = carryOver(target_, staging_, target->products, IfTaken::Refuse); !carried)
        return carried;
    if (auto synced = syncToDisk(staging_); !synced) return synced;
    if (auto swapped = swapFolders(staging_, target_); !swapped) return swapped;
    // What was the staging folder is the previous output now.
    const fs::path previous = std::exchange(staging_, {});
    if (auto synced = syncToDisk(target_.parent_path()); !synced) return synced;
    // Once more, for what others put there in the meantime.
    auto cleared = carryOver(previous, target_, target->products, IfTaken::Skip);
    if (cleared) {
        fs::remove_all(previous, error);
        if (error) cleared = failed("cannot remove", previous, error);
    }
    if (!cleared) {
        cleared.error().message = "the new output is in place, but the previous one could not be removed: " +
                                  cleared.error().message;
        cleared.error().cure = "remove " + previous.string() + " by hand";
    }
    return cleared;
}

Result<void> writeTextFile(const std::string& text, const fs::path& file) {
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    if (auto written = out->write(text); !written) return written;
    return out->commit();
}

}  // namespace terrawalk
