#include "coupler/participant.hpp"
