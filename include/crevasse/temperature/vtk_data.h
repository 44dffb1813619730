// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_vtk_data_h
#define crevasse_temperature_vtk_data_h

#include <string>
#include <string_view>
#include <vector>

namespace Crevasse
{
  /** How VTK's files in XML encode the numbers of an array. Whoever calls knows
   * how many there must be: nothing is allocated on the word of a header. */
  namespace VtkData
  {
    /** What does not fit is said without the name of file or array. */
    struct Corrupted
    {
      std::string reason;
    };

    struct Encoding
    {
      bool is_base64     = true; ///< or the bytes themselves
      bool is_compressed = false;
      bool has_long_head = false; ///< UInt64 instead of UInt32
    };

    /** The @p n_bytes of an array behind their header, which may be followed
     * by other arrays. @throw Corrupted */
    std::string
    decode(const std::string_view encoded,
           const Encoding         encoding,
           const std::size_t      n_bytes);

    /** Of Float64, Int32, ...; zero if there is no such type. */
    std::size_t
    size_of(const std::string &type);

    /** Little-endian numbers. */
    std::vector<double>
    from_bytes(const std::string &bytes, const std::string &type);

    /** Numbers separated by white space. @throw Corrupted */
    std::vector<double>
    from_text(const std::string &text);
  } // namespace VtkData
} // namespace Crevasse

#endif
