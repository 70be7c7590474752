# cpack -G DEB, in the build folder: one package of the command with its pages, the libraries and their headers.
set(CPACK_PACKAGE_CONTACT "the sklar developers <sklar@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For find_package(sklar): what sklarConfig.cmake asks for.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, pkg-config, libeigen3-dev, libboost-dev, libmpfr-dev, libhwy-dev, libnlopt-dev, \
libnlopt-cxx-dev, libopenexr-dev, libpng-dev, libcairo2-dev, libtbb-dev, libembree-dev, nlohmann-json3-dev")
set(CPACK_PACKAGE_DESCRIPTION "Archimedean copulas and what is made of them: density, distribution function,
conditional distributions, sampling and fits, exact over the whole domain, and
compact reflectance models (BRDFs) built on them, fitted to measured materials,
rendered and exported. Holds the command sklar and the C++ libraries.")
include(CPack)
