include(CMakePackageConfigHelpers)

install(TARGETS sklar_copula sklar_families sklar_plot sklar_brdf EXPORT sklarTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(module copula families brdf)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${module} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sklar FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sklar FILES_MATCHING PATTERN "*.hpp")
install(EXPORT sklarTargets NAMESPACE sklar:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sklar)

configure_package_config_file(cmake/sklarConfig.cmake.in ${PROJECT_BINARY_DIR}/sklarConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sklar)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sklarConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sklarConfig.cmake ${PROJECT_BINARY_DIR}/sklarConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sklar)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
