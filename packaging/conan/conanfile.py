"""Conan 2: conan create packaging/conan, from the top of a checkout."""

import os

from conan import ConanFile
from conan.tools.files import copy, load
from conan.tools.layout import basic_layout


class Hapbeam(ConanFile):
    name = "hapbeam"
    description = "Beams under a haptic hand: the force and the shape, a thousand times a second"
    license = "MIT"
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"model_file": [True, False]}
    default_options = {"model_file": False}
    no_copy_source = True

    def set_version(self):
        self.version = load(self, os.path.join(self.recipe_folder, "../VERSION")).strip()

    def export_sources(self):
        top = os.path.join(self.recipe_folder, "../..")
        for pattern in ("LICENSE", "include/*"):
            copy(self, pattern, top, self.export_sources_folder)

    def layout(self):
        basic_layout(self)

    def requirements(self):
        self.requires("eigen/[>=3.4]", transitive_headers=True)
        if self.options.model_file:
            self.requires("jansson/[>=2.10]", transitive_headers=True, transitive_libs=True)

    def package_id(self):
        self.info.settings.clear()

    def package(self):
        copy(self, "*.hpp", os.path.join(self.source_folder, "include"), os.path.join(self.package_folder, "include"))
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.bindirs = self.cpp_info.libdirs = []
        main = self.cpp_info.components["headers"]
        main.set_property("cmake_target_name", "hapbeam::hapbeam")
        main.requires = ["eigen::eigen"]
        if self.options.model_file:
            files = self.cpp_info.components["model_file"]
            files.set_property("cmake_target_name", "hapbeam::model_file")
            files.requires = ["headers", "jansson::jansson"]
