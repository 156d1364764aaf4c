// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/version.h"

#include <string_view>

#include <CGAL/version.h>
#include <OpenImageIO/oiioversion.h>
#include <fmt/format.h>

#include "cli/build_info.h"
#include "runtime_glsl/host/renderer.h"

namespace fetexc::cli {
namespace {

std::string back_ends_text() {
    std::string text = "back ends:\n  cpu              always";
    for (const fetex::Backend backend : fetex::kBackends) {
        const fetex::BackendStatus status = fetex::probe_backend(backend);
        text += fmt::format("\n  {:<16} {}{}", fetex::backend_name(backend),
                            status.available ? "" : "not here: ", status.detail);
    }
    return text;
}

} // namespace

std::string version_number() { return FETEXC_VERSION; }

std::string version_text() {
    const std::string_view commit = FETEXC_COMMIT;
    std::string text =
        fmt::format("fetexc {}{}\n", version_number(), commit.empty() ? "" : fmt::format(" (commit {})", commit));
    text += fmt::format("built with {}, {}; CGAL {}, OpenImageIO {}\n", FETEXC_COMPILER, FETEXC_BUILD_TYPE,
                        CGAL_VERSION_STR, OIIO_VERSION_STRING);
    return text + back_ends_text();
}

} // namespace fetexc::cli
