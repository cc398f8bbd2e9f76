#pragma once
// tinygltf without images and without the file system. Not installed; for the sources of GLB only.

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <fstream>
#include <nlohmann/json.hpp>
// tinygltf needs the above.
#include <tiny_gltf.h>
