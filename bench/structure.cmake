add_executable(bench_structure structure.cpp)
talus_settings(bench_structure)
target_link_libraries(bench_structure PRIVATE talus_fem fmt::fmt)
