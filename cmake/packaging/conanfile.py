"""Conan 2's recipe. Untested: written from the recipes' names, never run.

    conan create cmake/packaging                               # ninebit::combiner, which needs nothing but Highway
    conan create cmake/packaging -o 'ninebit/*:everything=True' -c tools.cmake.cmaketoolchain:extra_variables=...

Chart.js 3, which reports need, has no recipe: with everything, the variable NINEBIT_CHART_JS is the path of chart.min.js.
"""
import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy
from conan.tools.gnu import PkgConfigDeps


class Ninebit(ConanFile):
    name = 'ninebit'
    version = '0.1.0'
    license = 'MIT'
    description = 'GeForce 2 register combiners to the bit, and the shadow techniques built on them'
    package_type = 'static-library'
    settings = 'os', 'compiler', 'build_type', 'arch'
    options = {'everything': [True, False]}
    default_options = {'everything': False}
    generators = 'CMakeDeps'
    tool_requires = 'pkgconf/[>=2 <3]'

    def requirements(self):
        self.requires('highway/[>=1.0.3 <2]')
        if self.options.everything:
            for name in ('assimp/5.4.3', 'cairo/1.18.0', 'draco/1.5.6', 'embree3/3.13.5', 'fmt/[>=9 <12]', 'glm/1.0.1',
                         'libpng/[>=1.6 <2]', 'meshoptimizer/0.20', 'nlohmann_json/[>=3.11 <4]', 'onetbb/2021.12.0',
                         'openexr/3.3.2', 'openimageio/2.5.18.0', 'openssl/[>=3 <4]'):
                self.requires(name)

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        self.folders.root = '../..'
        cmake_layout(self)

    def export_sources(self):
        root = os.path.join(self.recipe_folder, '..', '..')
        for pattern in ('CMakeLists.txt', 'LICENSE', 'cmake/*', 'include/*', 'src/*'):
            copy(self, pattern, root, self.export_sources_folder)

    def generate(self):
        PkgConfigDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables['NINEBIT_COMBINER_ONLY'] = not self.options.everything
        for off in ('PROGRAM', 'TESTS'):
            toolchain.cache_variables['NINEBIT_BUILD_' + off] = False
        toolchain.cache_variables['NINEBIT_SHARED'] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):  # the package's own CMake files, with components that say what each needs
        self.cpp_info.set_property('cmake_find_mode', 'none')
        self.cpp_info.builddirs = ['lib/cmake/ninebit']
