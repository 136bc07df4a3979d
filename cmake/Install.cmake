# What `cmake --install` copies: the header, the tools, the documents, and a package for find_package(minirt).
include(CMakePackageConfigHelpers)

install(FILES ${PROJECT_SOURCE_DIR}/minirt.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS minirt EXPORT minirtTargets)
if(MINIRT_BUILD_TOOLS)
    set(tools minirtc minirt-render minirt-compare minirt-bench minirt-cost minirt-samples)
    if(TARGET minirt-viewer)
        list(APPEND tools minirt-viewer)
    endif()
    install(TARGETS ${tools} EXPORT minirtTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/minirt)
install(EXPORT minirtTargets NAMESPACE minirt:: DESTINATION ${package})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/minirtConfig.cmake.in ${PROJECT_BINARY_DIR}/minirtConfig.cmake
    INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/minirtConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/minirtConfig.cmake ${PROJECT_BINARY_DIR}/minirtConfigVersion.cmake DESTINATION ${package})

install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/LICENSE
    DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
