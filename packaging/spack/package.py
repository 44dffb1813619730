# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""A recipe for Spack; put it into packages/crevasse of a repository of yours
("spack repo create")."""

from spack.package import *


class Crevasse(CMakePackage):
    """Periodic states of cracked viscoelastic solids with one-sided contact on the
    crack lips."""

    license("LGPL-2.1-or-later")

    # With the address of the source, "git = ..." gives this version.
    version("main", branch="main")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("dealii@9.4:+mpi+p4est+trilinos+petsc+sundials+muparser+gmsh+hdf5")
    depends_on("trilinos+ml")
    depends_on("suite-sparse+umfpack+cholmod")
    depends_on("mumps+mpi+complex+double")
    depends_on("fftw")
    depends_on("muparser")
    depends_on("cli11")
    depends_on("nlohmann-json")
    depends_on("zlib-api")
    with default_args(type="run"):
        depends_on("python@3.11:")
        depends_on("py-h5py")
        depends_on("py-jinja2")
        depends_on("py-matplotlib")
        depends_on("py-meshio")
        depends_on("py-netcdf4")
        depends_on("py-pandas")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("CMAKE_BUILD_TYPE", "Release"),
            self.define("CREVASSE_TESTS", False),
            self.define("CREVASSE_PYTHON", self.spec["python"].command.path),
        ]
