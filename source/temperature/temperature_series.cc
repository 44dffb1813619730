// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/temperature/temperature_series.h>
#include <crevasse/temperature/vtk_xml_file.h>
#include <crevasse/temperature/vtu_reader.h>

#include <filesystem>
#include <functional>
#include <map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The files of one instant by the number of their part. */
    using Parts = std::map<std::string, std::string>;



    /** The files of all instants that a .pvd names. */
    std::map<double, Parts>
    read_collection(const std::string &file_name)
    {
      const VtkXmlFile file(file_name);
      if (file.type() != "Collection")
        file.refuse("its type is \"" + Text::shorten(file.type()) +
                    "\"; a .pvd file must be a Collection.");
      std::map<double, Parts> instants;
      for (const auto &[name, data_set] : file.content())
        if (name == "DataSet")
          {
            const std::string time =
              VtkXmlFile::attribute(data_set, "timestep");
            const std::string part  = VtkXmlFile::attribute(data_set, "part");
            const std::string other = VtkXmlFile::attribute(data_set, "file");
            const auto        t     = Text::to_number(time);
            if (!t)
              file.refuse("has a DataSet with timestep = \"" +
                          Text::shorten(time) +
                          "\"; it must be the instant within the period.");
            if (!instants[*t].emplace(part, file.neighbour(other)).second)
              file.refuse(
                "has two DataSets for timestep = " + Text::from_number(*t) +
                (part.empty() ? "" : ", part = " + part) + ".");
          }
      if (instants.empty())
        file.refuse("names no DataSet.");
      return instants;
    }



    /** A reader says which file is wrong; the user has to know why it was read
     * at all. */
    void
    tell_source(const std::string &file_name, const std::function<void()> &read)
    {
      try
        {
          read();
        }
      catch (const SceneError &error)
        {
          const std::string what   = error.what();
          const bool        is_own = what.rfind(file_name + ": ", 0) == 0;
          throw SceneError("[Loads] Temperature = " +
                           (is_own ? what : file_name + ": its file " + what));
        }
    }
  } // namespace



  template <int dim>
  TemperatureSeries<dim>::TemperatureSeries(const std::string &file_name,
                                            const double       period)
    : TemperatureFile<dim>(file_name, period)
  {
    std::map<double, Parts> files{{0., {{"", file_name}}}};
    if (Text::suffix(file_name) == ".pvd")
      tell_source(file_name, [&]() { files = read_collection(file_name); });
    std::vector<double> instants;
    for (const auto &[t, parts] : files)
      instants.push_back(t);
    this->set_instants(instants);

    for (const auto &[t, parts] : files)
      {
        std::vector<std::string> names;
        for (const auto &[part, name] : parts)
          names.push_back(name);
        tell_source(file_name, [&]() { add_snapshot(names); });
      }
  }



  std::vector<std::string>
  files_of_temperature(const std::string &file_name)
  {
    std::vector<std::string> all = {file_name};
    if (Text::suffix(file_name) == ".pvd")
      for (const auto &[t, parts] : read_collection(file_name))
        for (const auto &[part, name] : parts)
          all.push_back(name);
    const std::vector<std::string> named = all;
    for (const std::string &name : named)
      if (Text::suffix(name) == ".pvtu")
        {
          const VtkXmlFile file(name);
          for (const auto &[element, piece] : file.content())
            if (element == "Piece")
              all.push_back(
                file.neighbour(VtkXmlFile::attribute(piece, "Source")));
        }
    return all;
  }



  template <int dim>
  void
  TemperatureSeries<dim>::add_snapshot(const std::vector<std::string> &parts)
  {
    VertexField<dim> field;
    for (const std::string &part : parts)
      read_vtu(part, field);
    if (field.mesh.corners.empty())
      throw SceneError(parts[0] + ": has no cells of dimension " +
                       std::to_string(dim) + ".");

    Snapshot snapshot;
    for (const Snapshot &other : snapshots)
      if (other.locator->mesh() == field.mesh)
        snapshot.locator = other.locator;
    if (snapshot.locator == nullptr)
      snapshot.locator =
        std::make_shared<const CellLocator<dim>>(std::move(field.mesh));
    snapshot.values = std::move(field.values);
    snapshots.push_back(std::move(snapshot));
  }



  template <int dim>
  double
  TemperatureSeries<dim>::value_at_instant(const Point<dim> &point,
                                           const std::size_t instant) const
  {
    const Snapshot &snapshot = snapshots[instant];
    const auto      value    = snapshot.locator->value(point, snapshot.values);
    if (!value)
      this->refuse(
        "the body has the point " + Text::from_point(point) +
        ", which lies outside of the mesh" +
        (snapshots.size() == 1 ? ""
                               : " of instant " + std::to_string(instant + 1) +
                                   " of " + std::to_string(snapshots.size())) +
        ", further than " + Text::from_number(CellLocator<dim>::largest_gap) +
        " of the size of the cells there; the mesh must cover the "
        "body, in the same unit of length.");
    return *value;
  }



  template class TemperatureSeries<2>;
  template class TemperatureSeries<3>;
} // namespace Crevasse
