#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <memory>
#include <system_error>
#include <vector>

#include "io/output_folder.hpp"
#include "io/read_dem.hpp"

namespace terrawalk {

namespace {

struct DigestDeleter {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

using Digest = std::unique_ptr<EVP_MD_CTX, DigestDeleter>;

/// Null when OpenSSL offers none.
Digest newDigest() {
    Digest digest(EVP_MD_CTX_new());
    if (digest && EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) != 1) digest.reset();
    return digest;
}

std::string hexadecimal(EVP_MD_CTX& digest) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned size = 0;
    EVP_DigestFinal_ex(&digest, bytes.data(), &size);
    return fmt::format("{:02x}", fmt::join(bytes.begin(), bytes.begin() + size, ""));
}

tl::unexpected<Error> unreadable(const std::filesystem::path& file) {
    return systemError("cannot read: " + std::generic_category().message(errno), file);
}

}  // namespace

Result<std::string> sha256OfFile(const std::filesystem::path& file) {
    const FileHandle handle(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (!handle.isOpen()) return unreadable(file);
    const Digest digest = newDigest();
    if (!digest) return systemError("OpenSSL offers no SHA-256 on this machine");
    std::vector<unsigned char> block(1U << 20U);
    for (;;) {
        const ssize_t got = ::read(handle.get(), block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return unreadable(file);
        if (got == 0) break;
        EVP_DigestUpdate(digest.get(), block.data(), static_cast<std::size_t>(got));
    }
    return hexadecimal(*digest);
}

std::string sha256OfHeights(const ElevationGrid& heights) {
    const Digest digest = newDigest();
    if (!digest) return {};  // then nothing is told, and nothing compared
    constexpr std::size_t kCells = std::size_t{1} << 16U;
    // NaN has many forms, and so has zero; a file keeps neither.
    constexpr std::uint32_t kNothing = 0xFFFF'FFFFU;
    std::vector<std::uint32_t> block;
    for (std::size_t begin = 0; begin < heights.heights_m.size(); begin += kCells) {
        block.clear();
        const std::size_t end = std::min(begin + kCells, heights.heights_m.size());
        for (std::size_t cell = begin; cell < end; ++cell) {
            const float height = heights.heights_m[cell];
            block.push_back(std::isnan(height) ? kNothing : std::bit_cast<std::uint32_t>(height + 0.0F));
        }
        EVP_DigestUpdate(digest.get(), block.data(), block.size() * sizeof(std::uint32_t));
    }
    return hexadecimal(*digest);
}

}  // namespace terrawalk
