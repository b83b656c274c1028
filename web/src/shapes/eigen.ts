/** Axes of symmetric matrices. */

import { Matrix4, Quaternion } from "three";

export interface Principal {
  /** Eigenvalues; those that rounding made negative are 0. */
  readonly values: readonly [number, number, number];
  /** Rotation whose columns are the eigenvectors, right handed. */
  readonly rotation: Quaternion;
}

/**
 * Principal axes of a symmetric 3 × 3 matrix, row by row, by Jacobi's rotations (Numerical Recipes, 11.1).
 */
export function principalAxes(matrix: readonly number[]): Principal {
  const a = [0, 1, 2].map((row) => [0, 1, 2].map((column) => matrix[3 * row + column] ?? 0));
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < 32; sweep++) {
    const rest = Math.abs(at(a, 0, 1)) + Math.abs(at(a, 0, 2)) + Math.abs(at(a, 1, 2));
    if (rest < 1e-15) break;
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const)
      rotate(a, v, p, q);
  }
  const column = (index: number): [number, number, number] => [at(v, 0, index), at(v, 1, index), at(v, 2, index)];
  const [x, y] = [column(0), column(1)];
  const z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]] as const;
  const basis = new Matrix4().set(x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, 0, 0, 0, 1);
  return {
    values: [Math.max(0, at(a, 0, 0)), Math.max(0, at(a, 1, 1)), Math.max(0, at(a, 2, 2))],
    rotation: new Quaternion().setFromRotationMatrix(basis),
  };
}

function at(matrix: readonly (readonly number[])[], row: number, column: number): number {
  return matrix[row]?.[column] ?? 0;
}

/** One rotation that makes a[p][q] zero. */
function rotate(a: number[][], v: number[][], p: number, q: number): void {
  const apq = at(a, p, q);
  if (apq === 0) return;
  const theta = (at(a, q, q) - at(a, p, p)) / (2 * apq);
  const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.hypot(theta, 1));
  const c = 1 / Math.hypot(t, 1);
  const s = t * c;
  for (const m of [a, v]) {
    for (const row of m) {
      const [mp, mq] = [row[p] ?? 0, row[q] ?? 0];
      row[p] = c * mp - s * mq;
      row[q] = s * mp + c * mq;
    }
  }
  const [rowP, rowQ] = [a[p], a[q]];
  if (rowP === undefined || rowQ === undefined) return;
  for (let k = 0; k < 3; k++) {
    const [pk, qk] = [rowP[k] ?? 0, rowQ[k] ?? 0];
    rowP[k] = c * pk - s * qk;
    rowQ[k] = s * pk + c * qk;
  }
}
