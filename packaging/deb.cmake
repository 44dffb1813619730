# "cmake --build build --target package" makes crevasse_VERSION_ARCH.deb in the
# build directory: the program, its scripts, the scenes and the pages.
# packaging/try_deb.sh installs and runs it in a bare Debian.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME crevasse)
set(CPACK_PACKAGE_CONTACT "The Crevasse authors <crevasse@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "periodic states of cracked viscoelastic solids with contact")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME crevasse)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
# What the scripts import and inline; with Debian's default BLAS, factorisations
# take two to three times as long.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libjs-chart.js, libjs-three, python3-gmsh, \
python3-h5py, python3-jinja2, python3-matplotlib, python3-meshio, python3-netcdf4, python3-scipy, \
python3-pandas")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS libopenblas0-serial)

include(GNUInstallDirs)
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/prm
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT program)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/doc/
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/pages COMPONENT program
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.gif")

include(CPack)
