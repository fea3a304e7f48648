// Pictures and videos of the stage, as files.

import { film } from "./data.js";

const named = (ending) => `${film.title.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "") || "film"}.${ending}`;

function download(blob, ending) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = named(ending);
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** The picture that the canvas shows. */
export const picture = (canvas) => canvas.toBlob((blob) => download(blob, "png"), "image/png");

/** Endings by what browsers can record, the most widely played first. */
const KINDS = [["video/mp4", "mp4"], ["video/webm;codecs=vp9", "webm"], ["video/webm", "webm"]];

/** Whether this browser records videos. */
export const records = () => Boolean(globalThis.MediaRecorder && HTMLCanvasElement.prototype.captureStream);

/** Records what the canvas shows until the answer is called, which saves it. */
export function video(canvas) {
  const [type, ending] = KINDS.find(([kind]) => MediaRecorder.isTypeSupported(kind)) ?? ["", "webm"];
  const pieces = [];
  const recorder = new MediaRecorder(canvas.captureStream(60), { mimeType: type, videoBitsPerSecond: 12e6 });
  recorder.ondataavailable = ({ data }) => pieces.push(data);
  recorder.onstop = () => download(new Blob(pieces, { type }), ending);
  recorder.start();
  return () => recorder.stop();
}
