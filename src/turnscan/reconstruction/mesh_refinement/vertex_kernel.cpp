#include <turnscan/core/simd/kernel_dispatch.hpp>
#include <turnscan/reconstruction/mesh_refinement/vertex_kernel.hpp>

template class turnscan::KernelChoice<turnscan::mesh_refinement::VertexKernel>;
