talus_program(bench_mapping SOURCES mapping.cpp LINK talus_interface_mesh fmt::fmt)
