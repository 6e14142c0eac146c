# `cmake --install`: the library, the headers of what was built, luxelConfig.cmake for find_package, and the program.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
add_library(luxel::luxel ALIAS luxel)  # for those who add this folder instead of installing

# Headers: those that the library's own sources include, and what these include.
set(headers version.h status.h plan.h device.h reference.h)
set(todo ${headers})
foreach(source ${host} ${vulkan} ${opencl})
  if(NOT IS_ABSOLUTE ${source})
    set(source ${PROJECT_SOURCE_DIR}/${source})
  endif()
  file(STRINGS ${source} lines REGEX "^#include <luxel/")
  list(APPEND todo ${lines})
endforeach()
if(LUXEL_VULKAN)
  list(APPEND todo vulkan.h)
endif()
if(LUXEL_OPENCL)
  list(APPEND todo opencl.h)
endif()
while(todo)
  list(POP_FRONT todo header)
  string(REGEX REPLACE ".*<luxel/(.*)>.*" "\\1" header "${header}")
  if(NOT EXISTS ${PROJECT_SOURCE_DIR}/include/luxel/${header} OR header IN_LIST seen)
    continue()
  endif()
  list(APPEND seen ${header})
  list(APPEND headers ${header})
  file(STRINGS ${PROJECT_SOURCE_DIR}/include/luxel/${header} lines REGEX "^#include <luxel/")
  list(APPEND todo ${lines})
endwhile()
list(REMOVE_DUPLICATES headers)
list(TRANSFORM headers PREPEND ${PROJECT_SOURCE_DIR}/include/luxel/)
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/luxel)

# A shared library shows what the public headers declare, and hides the rest.
if(BUILD_SHARED_LIBS)
  if(LUXEL_TESTS OR LUXEL_BENCH)
    message(FATAL_ERROR "BUILD_SHARED_LIBS hides what tests and the program use; add -DLUXEL_TESTS=OFF -DLUXEL_BENCH=OFF")
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers} ${CMAKE_CURRENT_LIST_DIR}/exports.py)
  execute_process(COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/exports.py ${PROJECT_BINARY_DIR}/luxel.map ${headers}
                  COMMAND_ERROR_IS_FATAL ANY)
  target_link_options(luxel PRIVATE -Wl,--version-script=${PROJECT_BINARY_DIR}/luxel.map -Wl,--no-undefined)
  set_target_properties(luxel PROPERTIES LINK_DEPENDS ${PROJECT_BINARY_DIR}/luxel.map VISIBILITY_INLINES_HIDDEN ON
                        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()

install(TARGETS luxel EXPORT luxelTargets)
install(EXPORT luxelTargets NAMESPACE luxel:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/luxel)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/luxelConfig.cmake.in ${PROJECT_BINARY_DIR}/luxelConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/luxel)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/luxelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/luxelConfig.cmake ${PROJECT_BINARY_DIR}/luxelConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/luxel)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/luxel)
install(FILES ${PROJECT_SOURCE_DIR}/docs/emit.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/luxel)
if(TARGET luxel_program)
  install(TARGETS luxel_program RUNTIME COMPONENT tools)
  # What makes the page of a report; the program finds it from where it lies.
  file(GLOB report_scripts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/python/report/*.py)
  install(FILES ${report_scripts} DESTINATION ${CMAKE_INSTALL_DATADIR}/luxel/report COMPONENT tools)
  file(RELATIVE_PATH scripts_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/luxel/report)
  set_property(SOURCE ${PROJECT_SOURCE_DIR}/bench/report/report.cpp TARGET_DIRECTORY luxel_report
               APPEND PROPERTY COMPILE_DEFINITIONS LUXEL_SCRIPTS_FROM_BIN="${scripts_from_bin}")
endif()
