// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Whatever stands in a .msh file is refused with a message, or makes a body, in
// the plane and in space. In the Debug flavour deal.II's assertions tell where
// a mesh that it should not have been given makes it read anything.

#include <crevasse/model/body.h>

#include <deal.II/base/mpi.h>

#include <cstdint>

#include "input_file.h"

using namespace Crevasse;

namespace
{
  /** The boundary ids of one remainder, as a scene lists them. */
  std::string
  list_ids(const std::vector<dealii::types::boundary_id> &ids,
           const unsigned int                             remainder)
  {
    std::string list;
    for (const auto id : ids)
      if (id % 4 == remainder)
        list += (list.empty() ? "" : ", ") + std::to_string(id);
    return list.empty() ? "none" : list;
  }



  template <int dim>
  void
  make_body(const std::string &file_name)
  {
    Scene scene;
    scene.dimension          = dim;
    scene.geometry.shape     = Shape::mesh_file;
    scene.geometry.mesh_file = file_name;
    const auto mesh          = make_scene_mesh<dim>(scene, MPI_COMM_WORLD);

    // Roles for whatever ids the fuzzer has come to.
    const auto ids          = mesh->get_boundary_ids();
    scene.boundary.clamped  = list_ids(ids, 1);
    scene.boundary.contact  = list_ids(ids, 2);
    scene.boundary.symmetry = list_ids(ids, 3);
    scene.boundary.loaded   = list_ids(ids, 0);
    if (scene.boundary.loaded.text() != "none")
      scene.loads.traction = dim == 2 ? "0; 1" : "0; 0; 1";
    const Body<dim> body(scene, mesh);
  }
} // namespace



/** Open MPI keeps memory until the process ends. */
extern "C" const char *
__asan_default_options()
{
  return "detect_leaks=0";
}



extern "C" int
LLVMFuzzerInitialize(int *argc, char ***argv)
{
  static const dealii::Utilities::MPI::MPI_InitFinalize mpi(*argc, *argv, 1);
  return 0;
}



extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const ScratchFolder folder;
  const std::string          file_name =
    folder.write("mesh.msh", std::string(data, data + size));
  allow_refusal([&file_name]() { make_body<2>(file_name); });
  allow_refusal([&file_name]() { make_body<3>(file_name); });
  return 0;
}
