# 64-bit Arm by the distribution's cross compiler; what is built runs in qemu-user. The two libraries that the combiner
# and its tests need lie in build/arm-packages, where combiner_tests/arm/fetch put them.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)

get_filename_component(packages ${CMAKE_CURRENT_LIST_DIR}/../../build/arm-packages ABSOLUTE)
set(ENV{PKG_CONFIG_LIBDIR} ${packages}/usr/lib/aarch64-linux-gnu/pkgconfig)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${packages})
set(GTest_DIR ${packages}/usr/lib/aarch64-linux-gnu/cmake/GTest)
# Emitted C is loaded by the tests, and so must be of their kind.
set(NINEBIT_C_COMPILER ${CMAKE_C_COMPILER})
