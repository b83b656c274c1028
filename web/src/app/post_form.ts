/** Sends forms with files. */

/** Called with the bytes sent and the total [B]. */
export type Progress = (sent: number, total: number) => void;

/** Post a form by XMLHttpRequest, which unlike fetch reports its progress in every browser; throws a sentence. */
export function postForm(url: string, form: FormData, signal: AbortSignal, progress: Progress): Promise<string> {
  const request = new XMLHttpRequest();
  return new Promise((resolve, reject) => {
    request.upload.onprogress = ({ loaded, total }) => progress(loaded, total);
    request.onload = () =>
      request.status === 200 ? resolve(request.responseText) : reject(new Error(request.responseText.trim()));
    request.onerror = () => reject(new Error("the connection was lost"));
    request.onabort = () => reject(new DOMException("cancelled", "AbortError"));
    signal.addEventListener("abort", () => request.abort());
    request.open("POST", url);
    request.send(form);
  });
}
