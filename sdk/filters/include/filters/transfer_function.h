#pragma once

#include <filters/transfer_function.hpp>
