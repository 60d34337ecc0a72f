# What `cmake --install` and `cpack` take away: the program with its man pages, completion, models and docs (component
# runtime, package signorini), the library (component development, package libsignorini-dev).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Man pages, completion and schema come from the program itself.
set(texts ${PROJECT_BINARY_DIR}/texts)
add_custom_command(TARGET signorini_program POST_BUILD VERBATIM
  COMMAND ${CMAKE_COMMAND} -E make_directory ${texts}/man
  COMMAND $<TARGET_FILE:signorini_program> man --write ${texts}/man > ${texts}/pages
  COMMAND $<TARGET_FILE:signorini_program> completion bash > ${texts}/signorini
  COMMAND $<TARGET_FILE:signorini_program> completion zsh > ${texts}/_signorini
  COMMAND $<TARGET_FILE:signorini_program> schema > ${texts}/schema.json)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/signorini)
install(TARGETS signorini_program COMPONENT runtime)
install(DIRECTORY ${texts}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
install(FILES ${texts}/signorini DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)
install(FILES ${texts}/_signorini DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT runtime)
install(FILES ${texts}/schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/signorini COMPONENT runtime)
install(DIRECTORY models DESTINATION ${CMAKE_INSTALL_DATADIR}/signorini COMPONENT runtime)
install(FILES README.md CHANGELOG.md LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT runtime)
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)

install(TARGETS signorini EXPORT signorini-targets COMPONENT development)
install(DIRECTORY include/signorini DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT signorini-targets NAMESPACE signorini:: DESTINATION ${config_dir} COMPONENT development)
configure_package_config_file(scripts/signorini-config.cmake.in signorini-config.cmake
                              INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(signorini-config-version.cmake COMPATIBILITY SameMinorVersion)
# The headers that the library is built with, as they are when it is installed.
install(CODE "include(\"${PROJECT_SOURCE_DIR}/scripts/interface.cmake\")
interface_of(\"${PROJECT_SOURCE_DIR}\" interface)
file(WRITE \"${PROJECT_BINARY_DIR}/signorini-interface.cmake\" \"set(signorini_INTERFACE \${interface})\\n\")"
        COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/signorini-config.cmake ${PROJECT_BINARY_DIR}/signorini-config-version.cmake
              ${PROJECT_BINARY_DIR}/signorini-interface.cmake
        DESTINATION ${config_dir} COMPONENT development)
# The tree may be moved: the prefix is seen from the folder of the .pc file.
file(RELATIVE_PATH from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(scripts/signorini.pc.in signorini.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/signorini.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

# `cmake --build build/release && cpack --config build/release/CPackConfig.cmake`: two packages for Debian 12.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Signorini project <signorini@localhost>")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME signorini)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "The program, its models, docs and man pages.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsignorini-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libsundials-dev (>= 6.4), libsuitesparse-dev, libeigen3-dev (>= 3.4), libgsl-dev, libfmt-dev, libtomlplusplus-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "The C++ library, for CMake and pkg-config.")
include(CPack)
