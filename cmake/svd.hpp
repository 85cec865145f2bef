// The SVD that trains reduced models takes g++ five seconds to compile.  The project's own programs compile it once, in svd.cpp:
// their precompiled headers include this file.
#pragma once

#include <Eigen/Core>
#include <Eigen/SVD>

extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;
