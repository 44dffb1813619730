// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/model/mesh_materials.h>
#include <crevasse/parameters/effects.h>
#include <crevasse/parameters/physical_names.h>

#include <deal.II/base/mpi.h>

#include <regex>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Ids = std::set<types::material_id>;



    /** Material ids of all ranks: each rank knows the coarse mesh. */
    template <int dim>
    Ids
    material_ids(const Mesh<dim> &mesh)
    {
      Ids ids;
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        ids.insert(cell->material_id());
      return ids;
    }



    /** Formats an id and its name: "1 (blade)". */
    std::string
    describe(const unsigned int                         id,
             const std::map<unsigned int, std::string> &names)
    {
      const auto name = names.find(id);
      return std::to_string(id) +
             (name == names.end() ? "" : " (" + name->second + ')');
    }



    /** Material ids with which a formula compares. */
    std::set<unsigned int>
    compared_ids(const std::string &formula)
    {
      static const std::regex comparison(
        "\\bmaterial *[=!]= *(\\d{1,9})(?![\\w.])|(?:^|[^\\w.])(\\d{1,9}) "
        "*[=!]= "
        "*material\\b");
      std::set<unsigned int> ids;
      for (std::sregex_iterator
             part(formula.begin(), formula.end(), comparison),
           end;
           part != end;
           ++part)
        ids.insert(std::stoul((*part)[(*part)[1].matched ? 1 : 2]));
      return ids;
    }



    std::vector<Expression>
    formulas_of(const MaterialParameters &material)
    {
      std::vector<Expression> formulas = stiffness_formulas(material);
      for (const Expression &formula : viscosity_formulas(material))
        formulas.push_back(formula);
      for (const auto &strain : material.free_strains())
        formulas.insert(formulas.end(),
                        strain.components->begin(),
                        strain.components->end());
      return formulas;
    }
  } // namespace



  std::set<unsigned int>
  compared_materials(const Scene &scene)
  {
    std::set<unsigned int> all;
    for (const Expression &formula : formulas_of(scene.material))
      all.merge(compared_ids(formula.formula()));
    return all;
  }



  template <int dim>
  void
  require_materials(const Scene &scene, const Mesh<dim> &mesh)
  {
    const Ids existing = material_ids(mesh);
    // Missing ids by parameter and formula, without repetition.
    std::map<std::string, std::set<unsigned int>> missing;
    for (const Expression &formula : formulas_of(scene.material))
      for (const unsigned int id : compared_ids(formula.formula()))
        if (existing.count(id) == 0)
          missing[formula.parameter() + " = " +
                  Text::shorten(formula.formula())]
            .insert(id);
    if (missing.empty())
      return;
    const auto               names = material_names(scene); // reads file
    std::vector<std::string> list;
    for (const auto id : existing)
      list.push_back(describe(id, names));
    Problems all;
    for (const auto &[formula, ids] : missing)
      for (const unsigned int id : ids)
        all.add(formula + ": no cell of the mesh has the material id " +
                describe(id, names) + "; there are: " + Text::join(list, ", "));
    all.throw_if_any();
  }



  template <int dim>
  std::string
  describe_materials(const Scene &scene, const Mesh<dim> &mesh)
  {
    std::map<unsigned int, std::size_t> n_cells;
    for (const auto &cell : owned_cells(mesh))
      ++n_cells[cell->material_id()];
    const auto               names = material_names(scene);
    std::vector<std::string> parts;
    for (const auto id : material_ids(mesh))
      {
        const auto n =
          Utilities::MPI::sum(n_cells[id], mesh.get_communicator());
        parts.push_back(describe(id, names) + ": " + std::to_string(n) +
                        (n == 1 ? " cell" : " cells"));
      }
    return Text::join(parts, ", ");
  }



  template decltype(require_materials<2>)  require_materials<2>;
  template decltype(require_materials<3>)  require_materials<3>;
  template decltype(describe_materials<2>) describe_materials<2>;
  template decltype(describe_materials<3>) describe_materials<3>;
} // namespace Crevasse
