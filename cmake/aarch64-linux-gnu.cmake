# Toolchain: Debian's cross compiler for aarch64, libraries from PERENTIE_ARM64_SYSROOT (made by
# arm64_sysroot.sh), programs run under qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PERENTIE_ARM64_SYSROOT)
set(CMAKE_FIND_ROOT_PATH ${PERENTIE_ARM64_SYSROOT} /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

# The loader and the C library are the cross compiler's; others are found by the build's rpaths. Those
# that a library needs in its turn (libedit needs two) are found by ours: only the old kind of rpath
# also counts for them.
set(perentie_arm64_libraries
  ${PERENTIE_ARM64_SYSROOT}/usr/lib/aarch64-linux-gnu:${PERENTIE_ARM64_SYSROOT}/lib/aarch64-linux-gnu)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,--disable-new-dtags,-rpath,${perentie_arm64_libraries}")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
