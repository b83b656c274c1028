/** Values that are polled while they are shown. */

import { useEffect, useState } from "preact/hooks";

const REFRESH = 100; // ms

/** Value that is polled ten times a second. */
export function useSampled<T>(read: () => T): T {
  const [, refresh] = useState(0);
  useEffect(() => {
    const timer = setInterval(() => refresh((times) => times + 1), REFRESH);
    return () => clearInterval(timer);
  }, []);
  return read();
}
