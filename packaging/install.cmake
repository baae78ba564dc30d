# What `make install` and the Debian package hold. Two components: the program with its materials, examples,
# templates, man page, schema and Python package; and the library with its public headers. The
# package is the program alone.
include(GNUInstallDirs)
set(share ${CMAKE_INSTALL_DATAROOTDIR}/bolide)

# The man page lists the commands as the program itself explains them; editors take the schema.
set(man_page ${CMAKE_BINARY_DIR}/bolide.1)
set(schema ${CMAKE_BINARY_DIR}/case.schema.json)
set(make_man_page ${CMAKE_SOURCE_DIR}/packaging/man-page)
set(man_template ${CMAKE_SOURCE_DIR}/packaging/bolide.1.in)
add_custom_command(OUTPUT ${man_page}
    COMMAND ${make_man_page} $<TARGET_FILE:bolide> ${man_template} > ${man_page}
    DEPENDS bolide ${make_man_page} ${man_template} VERBATIM)
add_custom_command(OUTPUT ${schema}
    COMMAND bolide schema > ${schema}
    DEPENDS bolide VERBATIM)
add_custom_target(install_files ALL DEPENDS ${man_page} ${schema} libbolide)

install(TARGETS bolide RUNTIME COMPONENT program)
install(FILES ${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${schema} DESTINATION ${share} COMPONENT program)
install(DIRECTORY materials examples templates DESTINATION ${share} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)
find_file(BOLIDE_DYGRAPHS_LICENCE copyright PATHS /usr/share/doc/libjs-dygraphs NO_DEFAULT_PATH)
if(BOLIDE_DYGRAPHS_LICENCE) # pages hold its script
    install(FILES ${BOLIDE_DYGRAPHS_LICENCE} DESTINATION ${CMAKE_INSTALL_DOCDIR}
        RENAME copyright.dygraphs COMPONENT program)
endif()
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
    PATTERN outputs EXCLUDE)

# Where Python looks for packages: below /usr Debian's folder of all versions; below another prefix
# the folder of one version, which Debian calls otherwise than others do.
find_program(BOLIDE_PYTHON_HERE NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(BOLIDE_PYTHON_HERE NAMES python3)
set(python_version 3)
if(BOLIDE_PYTHON_HERE)
    execute_process(COMMAND ${BOLIDE_PYTHON_HERE} -c "import sys; print('%d.%d' % sys.version_info[:2])"
        OUTPUT_VARIABLE python_version OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
set(python_packages site-packages)
if(EXISTS /usr/lib/python3/dist-packages)
    set(python_packages dist-packages)
endif()
install(CODE "set(bolide_python lib/python${python_version}/${python_packages})
    if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\" AND \"${python_packages}\" STREQUAL \"dist-packages\")
        set(bolide_python lib/python3/dist-packages)
    endif()" COMPONENT program)
install(DIRECTORY python/bolide DESTINATION "\${bolide_python}" COMPONENT program
    FILES_MATCHING PATTERN "*.py")

# The headers keep their modules: a program that uses the library writes `#include "case/case.h"`.
install(TARGETS libbolide ARCHIVE COMPONENT library)
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bolide COMPONENT library
    FILES_MATCHING PATTERN "*.h" PATTERN "*_internal.h" EXCLUDE PATTERN cli EXCLUDE)
set(pkg_config_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pkg_config_to_prefix /prefix/${pkg_config_folder} /prefix)
if(BOLIDE_MPI)
    list(JOIN MPI_C_LIBRARIES " " mpi_libraries)
endif()
configure_file(packaging/bolide.pc.in bolide.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/bolide.pc DESTINATION ${pkg_config_folder} COMPONENT library)

# cpack -G DEB: what the program is linked with becomes its dependencies; pictures need a font.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Bolide authors")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/package)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME bolide)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"Bolide computes what happens inside matter that is struck hard: shock fronts,
elastic and plastic waves, collapsing pores, perforated plates. A case is one
file that also says what its result must be.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-h5py, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS ffmpeg)
include(CPack)
