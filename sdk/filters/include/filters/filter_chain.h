#pragma once

#include <filters/filter_chain.hpp>
