#include "interface_mesh/surface.hpp"
