#define TINYGLTF_IMPLEMENTATION
#include <turnscan/io/tinygltf.hpp>
