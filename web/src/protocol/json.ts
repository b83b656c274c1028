/** JSON from outside: the one place where text becomes values. */

export type Json = string | number | boolean | null | readonly Json[] | { readonly [key: string]: Json };

/** Value of a text; throws a SyntaxError where it is no JSON. */
export function parseJson(text: string): Json {
  return JSON.parse(text) as Json; // JSON has no other values
}
