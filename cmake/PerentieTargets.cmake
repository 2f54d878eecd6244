# How a library, a program and a test of this project are declared.

# Warnings and sanitizers of our own code; system headers (Boost, gtest, ...) are not concerned.
add_library(perentie_build_flags INTERFACE)
target_compile_features(perentie_build_flags INTERFACE cxx_std_20)
target_compile_options(perentie_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${PERENTIE_WARNINGS_AS_ERRORS}>:-Werror>)
if(PERENTIE_SANITIZE)
  target_compile_options(perentie_build_flags INTERFACE
    -fsanitize=${PERENTIE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(perentie_build_flags INTERFACE -fsanitize=${PERENTIE_SANITIZE})
endif()

# perentie_add_library(lts SOURCES src/a.cpp ... PUBLIC perentie::base PRIVATE Boost::headers)
# makes the target perentie::lts with include/ public and src/ private.
function(perentie_add_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;PUBLIC;PRIVATE")
  add_library(perentie_${name} STATIC ${arg_SOURCES})
  add_library(perentie::${name} ALIAS perentie_${name})
  target_include_directories(perentie_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(perentie_${name}
    PUBLIC ${arg_PUBLIC}
    PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:perentie_build_flags>)
  target_compile_features(perentie_${name} PUBLIC cxx_std_20)
endfunction()

# perentie_add_test(lts_tests SOURCES ... LIBRARIES perentie::lts [LABELS unit] [WORKING_DIRECTORY d])
# makes a GoogleTest program whose tests CTest knows one by one. Under CTest rapidcheck draws the same
# cases on every run; run the program itself for other ones, or set RC_PARAMS there. Under an emulator
# it draws fewer.
function(perentie_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES;LABELS")
  if(NOT arg_LABELS)
    set(arg_LABELS unit)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} perentie_test_support GTest::gtest_main
                                        perentie_build_flags)
  set(cases "seed=20261120")
  if(CMAKE_CROSSCOMPILING_EMULATOR)
    string(APPEND cases " max_success=20")
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 600 ENVIRONMENT "RC_PARAMS=${cases}")
endfunction()
