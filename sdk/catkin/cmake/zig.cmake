# The C++ library of Zig for all libraries of the kit and of packages. Zig links a hidden copy into each, whose streams,
# locales and exceptions are not those of the others.
#
# TRUNDLE_ZIG: folder of Zig's library.
enable_language(C)
enable_language(ASM)
set(_trundle_cxx "${TRUNDLE_ZIG}/libcxx/src")
set(_trundle_abi "${TRUNDLE_ZIG}/libcxxabi/src")
set(_trundle_unwind "${TRUNDLE_ZIG}/libunwind/src")
file(GLOB _trundle_sources "${_trundle_cxx}/*.cpp" "${_trundle_cxx}/filesystem/*.cpp" "${_trundle_cxx}/ryu/*.cpp"
  "${_trundle_abi}/*.cpp")
# Those of other systems, of time zones, and those that libcxxabi has.
list(FILTER _trundle_sources EXCLUDE REGEX
  "noexception|ibm|win32|pstl|experimental|tzdb|time_zone|legacy_pointer|new_delete_fallback|libcxx/src/new.cpp")
add_library(trundle_cxx SHARED ${_trundle_sources} "${_trundle_unwind}/libunwind.cpp" "${_trundle_unwind}/UnwindLevel1.c"
  "${_trundle_unwind}/UnwindLevel1-gcc-ext.c" "${_trundle_unwind}/UnwindRegistersRestore.S"
  "${_trundle_unwind}/UnwindRegistersSave.S")
set_target_properties(trundle_cxx PROPERTIES CXX_STANDARD 23 CXX_SCAN_FOR_MODULES OFF)
target_compile_definitions(trundle_cxx PRIVATE _LIBCPP_BUILDING_LIBRARY LIBCXX_BUILDING_LIBCXXABI
  _LIBCXXABI_BUILDING_LIBRARY HAVE___CXA_THREAD_ATEXIT_IMPL _LIBUNWIND_IS_NATIVE_ONLY)
target_compile_options(trundle_cxx PRIVATE -w $<$<COMPILE_LANGUAGE:C>:-funwind-tables>)
set_source_files_properties("${_trundle_unwind}/libunwind.cpp" PROPERTIES COMPILE_OPTIONS "-fno-exceptions;-fno-rtti")
target_include_directories(trundle_cxx PRIVATE "${_trundle_cxx}" "${TRUNDLE_ZIG}/libcxxabi/include"
  "${TRUNDLE_ZIG}/libcxx/libc" "${TRUNDLE_ZIG}/libunwind/include")
install(TARGETS trundle_cxx LIBRARY DESTINATION lib)
add_link_options(-nostdlib++)
target_link_options(trundle_cxx PRIVATE -nostdlib++)
link_libraries(trundle_cxx)
