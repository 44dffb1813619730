// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/linear/complex_product.h>

namespace Crevasse
{
  using namespace dealii;

  void
  complex_product(const TrilinosWrappers::SparseMatrix             &real,
                  const TrilinosWrappers::SparseMatrix             &imaginary,
                  const LinearAlgebra::distributed::Vector<double> &x_real,
                  const LinearAlgebra::distributed::Vector<double> &x_imaginary,
                  LinearAlgebra::distributed::Vector<double>       &y_real,
                  LinearAlgebra::distributed::Vector<double>       &y_imaginary)
  {
    LinearAlgebra::distributed::Vector<double> product(y_real);
    real.vmult(y_real, x_real);
    imaginary.vmult(product, x_imaginary);
    y_real -= product;
    real.vmult(y_imaginary, x_imaginary);
    imaginary.vmult(product, x_real);
    y_imaginary += product;
  }
} // namespace Crevasse
