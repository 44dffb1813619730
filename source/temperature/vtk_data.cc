// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/temperature/vtk_data.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <zlib.h>

namespace Crevasse
{
  namespace VtkData
  {
    namespace
    {
      [[noreturn]] void
      break_off()
      {
        throw Corrupted{"breaks off, or has a wrong length in its header"};
      }



      std::vector<unsigned char>
      from_base64(const std::string_view text)
      {
        try
          {
            return dealii::Utilities::decode_base64(std::string(text));
          }
        catch (const std::exception &)
          {
            throw Corrupted{"has a character that is not one of base64"};
          }
      }



      /** The first bytes, or all that there are if these are less. */
      std::string
      first_bytes(std::string_view  encoded,
                  const bool        is_base64,
                  const std::size_t n)
      {
        if (n > encoded.size())
          break_off();
        if (!is_base64)
          return std::string(encoded.substr(0, n));

        // Some programs encode header and data in one, some apart from each
        // other, so that the padding of the former stands in between.
        std::string bytes;
        while (bytes.size() < n)
          {
            std::size_t length =
              std::min(4 * ((n - bytes.size() + 2) / 3), encoded.size());
            const std::size_t padding = encoded.substr(0, length).find('=');
            if (padding != std::string_view::npos)
              length = 4 * (padding / 4 + 1);
            if (length % 4 != 0 || length > encoded.size() || length == 0)
              break_off();
            const auto part = from_base64(encoded.substr(0, length));
            if (part.empty())
              break_off();
            bytes.append(part.begin(), part.end());
            encoded.remove_prefix(length);
          }
        bytes.resize(n);
        return bytes;
      }



      template <typename Number>
      std::vector<Number>
      reinterpret(const std::string &bytes)
      {
        std::vector<Number> numbers(bytes.size() / sizeof(Number));
        // An empty vector need not have an address.
        if (!numbers.empty())
          std::memcpy(numbers.data(),
                      bytes.data(),
                      numbers.size() * sizeof(Number));
        return numbers;
      }



      template <typename Number>
      std::vector<double>
      convert(const std::string &bytes)
      {
        const std::vector<Number> numbers = reinterpret<Number>(bytes);
        return {numbers.begin(), numbers.end()};
      }



      std::vector<std::uint64_t>
      header(const std::string_view encoded,
             const Encoding         encoding,
             const std::size_t      n)
      {
        const std::size_t width = encoding.has_long_head ? 8 : 4;
        const std::string bytes =
          first_bytes(encoded, encoding.is_base64, n * width);
        if (encoding.has_long_head)
          return reinterpret<std::uint64_t>(bytes);
        const auto numbers = reinterpret<std::uint32_t>(bytes);
        return {numbers.begin(), numbers.end()};
      }



      std::string
      inflate(const std::string_view compressed, const std::size_t n_bytes)
      {
        // Nothing that zlib writes is more than 1032 times smaller.
        if (n_bytes / 1100 > compressed.size())
          break_off();
        std::string block(n_bytes, '\0');
        uLongf      length = n_bytes;
        const int   status =
          uncompress(reinterpret_cast<Bytef *>(block.data()),
                     &length,
                     reinterpret_cast<const Bytef *>(compressed.data()),
                     compressed.size());
        if (status != Z_OK || length != n_bytes)
          throw Corrupted{"cannot be decompressed"};
        return block;
      }



      /** Blocks of equal size but for the last; the header has their number,
       * this size, that of the last if it differs, and the compressed sizes. */
      std::string
      decompress(const std::string_view encoded,
                 const Encoding         encoding,
                 const std::size_t      n_bytes)
      {
        const std::size_t n_blocks = header(encoded, encoding, 3)[0];
        if (n_blocks > encoded.size() / 4)
          break_off();
        const auto  head  = header(encoded, encoding, 3 + n_blocks);
        std::size_t total = head.size() * (encoding.has_long_head ? 8 : 4);
        std::size_t begin = total;
        for (std::size_t block = 0; block < n_blocks; ++block)
          if (head[3 + block] > encoded.size())
            break_off();
          else
            total += head[3 + block];
        const std::string all = first_bytes(encoded, encoding.is_base64, total);

        std::string bytes;
        for (std::size_t block = 0; block < n_blocks; ++block)
          {
            const bool          is_last = block + 1 == n_blocks && head[2] != 0;
            const std::uint64_t size    = is_last ? head[2] : head[1];
            if (size > n_bytes - bytes.size())
              break_off();
            bytes +=
              inflate(std::string_view(all).substr(begin, head[3 + block]),
                      size);
            begin += head[3 + block];
          }
        if (bytes.size() != n_bytes)
          break_off();
        return bytes;
      }
    } // namespace



    std::string
    decode(const std::string_view encoded,
           const Encoding         encoding,
           const std::size_t      n_bytes)
    {
      if (encoding.is_compressed)
        return decompress(encoded, encoding, n_bytes);
      if (header(encoded, encoding, 1)[0] != n_bytes)
        break_off();
      const std::size_t begin = encoding.has_long_head ? 8 : 4;
      return first_bytes(encoded, encoding.is_base64, begin + n_bytes)
        .substr(begin);
    }



    std::size_t
    size_of(const std::string &type)
    {
      for (const char *name : {"Int", "UInt", "Float"})
        for (const unsigned int bits : {8, 16, 32, 64})
          if (type == name + std::to_string(bits) &&
              (bits >= 32 || *name != 'F'))
            return bits / 8;
      return 0;
    }



    std::vector<double>
    from_bytes(const std::string &bytes, const std::string &type)
    {
      if (type == "Float64")
        return convert<double>(bytes);
      if (type == "Float32")
        return convert<float>(bytes);
      const std::size_t size        = size_of(type);
      const bool        is_unsigned = type[0] == 'U';
      if (size == 8)
        return is_unsigned ? convert<std::uint64_t>(bytes)
                           : convert<std::int64_t>(bytes);
      if (size == 4)
        return is_unsigned ? convert<std::uint32_t>(bytes)
                           : convert<std::int32_t>(bytes);
      if (size == 2)
        return is_unsigned ? convert<std::uint16_t>(bytes)
                           : convert<std::int16_t>(bytes);
      return is_unsigned ? convert<std::uint8_t>(bytes)
                         : convert<std::int8_t>(bytes);
    }



    std::vector<double>
    from_text(const std::string &text)
    {
      constexpr char white_space[] = " \t\r\n";

      std::vector<double> numbers;
      const char *const   end = text.data() + text.size();
      for (std::size_t place = text.find_first_not_of(white_space);
           place != std::string::npos;
           place = text.find_first_not_of(white_space, place))
        {
          const std::size_t stop =
            std::min(text.find_first_of(white_space, place), text.size());
          double     number = 0.;
          const auto result = std::from_chars(text.data() + place, end, number);
          if (result.ec != std::errc() || result.ptr != text.data() + stop)
            throw Corrupted{"has \"" +
                            Text::shorten(text.substr(place, stop - place)) +
                            "\" where a number must be"};
          numbers.push_back(number);
          place = stop;
        }
      return numbers;
    }
  } // namespace VtkData
} // namespace Crevasse
