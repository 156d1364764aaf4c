# SPDX-License-Identifier: GPL-3.0-or-later
# Libraries of the machine that more than one folder uses. Debian packages are listed in ./dev.
include_guard(GLOBAL)
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

# Debian's CMake configuration of OpenImageIO insists on the programs of openimageio-tools; pkg-config does not.
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET GLOBAL OpenImageIO)
add_library(fetexc_oiio INTERFACE)
target_link_libraries(fetexc_oiio INTERFACE PkgConfig::OpenImageIO)
