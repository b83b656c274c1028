#pragma once

/** Largest size of a written chunk [bytes]. */
constexpr int kChunkBytes = 1000;
