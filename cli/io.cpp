// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/io.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

namespace fs = std::filesystem;

Error io_error(int code, const std::string& path, const char* what, int err) {
    return {ErrorClass::Io, code, std::string(what) + ": " + std::strerror(err), path};
}

/// Closes on every way out.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ > STDERR_FILENO) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int get() const { return fd_; }
    /// Some file systems report a full disk only here.
    [[nodiscard]] bool close() {
        const int fd = std::exchange(fd_, -1);
        return ::close(fd) == 0;
    }

  private:
    int fd_;
};

bool write_all(int fd, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

Status write_in_place(const std::string& path, int fd, std::span<const std::uint8_t> bytes) {
    if (!write_all(fd, bytes)) return io_error(diag::kCannotWrite, path, "can't write", errno);
    return {};
}

mode_t mode_for(const std::string& target) {
    struct stat existing {};
    if (::stat(target.c_str(), &existing) == 0) return existing.st_mode & 07777;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

/// Where a symbolic link points, so that the rename replaces the file and not the link.
std::string resolve_link(const std::string& path) {
    std::error_code ec;
    if (!fs::is_symlink(path, ec)) return path;
    const fs::path target = fs::weakly_canonical(path, ec);
    return ec ? path : target.string();
}

fs::path folder_of(const std::string& target) {
    const fs::path folder = fs::path(target).parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

/// What a path to write to names.
struct Target {
    std::string path;
    bool in_place = false; ///< a device or a pipe
};

Result<Target> target_of(const std::string& path) {
    std::string target = resolve_link(path);
    std::error_code ec;
    const fs::file_status status = fs::status(target, ec);
    if (fs::is_directory(status)) return io_error(diag::kCannotCreate, path, "can't create", EISDIR);
    return Target{std::move(target), fs::exists(status) && !fs::is_regular_file(status)};
}

Status write_and_rename(const std::string& path, const std::string& target, std::span<const std::uint8_t> bytes) {
    std::string temporary = (folder_of(target) / ".fetexc-XXXXXX.tmp").string();
    Descriptor file(::mkostemps(temporary.data(), 4, O_CLOEXEC));
    if (file.get() < 0) return io_error(diag::kCannotCreate, path, "can't create", errno);
    const bool written = write_all(file.get(), bytes) && ::fchmod(file.get(), mode_for(target)) == 0 && file.close();
    if (written && ::rename(temporary.c_str(), target.c_str()) == 0) return {};
    const int err = errno;
    ::unlink(temporary.c_str());
    return io_error(diag::kCannotWrite, path, "can't write", err);
}

} // namespace

Result<std::vector<std::uint8_t>> read_input(const std::string& path, std::uint64_t limit) {
    Descriptor file(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) return io_error(diag::kCannotOpen, path, "can't open", errno);
    std::vector<std::uint8_t> bytes;
    std::array<std::uint8_t, 65536> block;
    for (;;) {
        const ssize_t n = ::read(file.get(), block.data(), block.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return io_error(diag::kCannotRead, path, "can't read", errno);
        if (n == 0) return bytes;
        bytes.insert(bytes.end(), block.begin(), block.begin() + n);
        if (bytes.size() > limit) {
            return Error{ErrorClass::InvalidInput, diag::kInputTooLong,
                         "longer than the limit of " + std::to_string(limit) + " bytes", path};
        }
    }
}

Status write_output(const std::string& path, std::span<const std::uint8_t> bytes) {
    if (path == "-") return write_in_place(path, STDOUT_FILENO, bytes);
    const auto target = target_of(path);
    if (!target) return target.error();
    if (!target.value().in_place) return write_and_rename(path, target.value().path, bytes);
    Descriptor device(::open(target.value().path.c_str(), O_WRONLY | O_CLOEXEC));
    if (device.get() < 0) return io_error(diag::kCannotCreate, path, "can't open", errno);
    return write_in_place(path, device.get(), bytes);
}

Status write_output(const std::string& path, const std::string& text) {
    return write_output(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Status check_output(const std::string& path) {
    if (path == "-") return {};
    const auto target = target_of(path);
    if (!target) return target.error();
    // "folder/." is there only if it is a folder.
    const std::string needed =
        target.value().in_place ? target.value().path : (folder_of(target.value().path) / ".").string();
    if (::access(needed.c_str(), W_OK) != 0) return io_error(diag::kCannotCreate, path, "can't create", errno);
    return {};
}

std::string identity(const std::string& path) {
    if (path == "-") return path;
    std::error_code ec;
    // Without a folder that exists, weakly_canonical would leave a relative path as it is.
    const fs::path resolved = fs::weakly_canonical(fs::absolute(path, ec), ec);
    return ec ? path : resolved.string();
}

bool same_file(const std::string& a, const std::string& b) {
    if (a == "-" || b == "-") return false;
    std::error_code ec;
    return fs::equivalent(a, b, ec) && !ec;
}

Status make_folder(const std::string& path) {
    std::error_code ec;
    fs::create_directories(path, ec);
    if (ec) return io_error(diag::kCannotMakeFolder, path, "can't make the folder", ec.value());
    return {};
}

} // namespace fetexc::cli
