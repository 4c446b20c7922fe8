/** Which of the files that a person dropped is what. */

import type { Upload } from "../../service/maps";

const PICTURE = /\.(png|pgm|pnm|bmp|tiff?|jpe?g|webp)$/i;
const YAML = /\.ya?ml$/i;
const JSON_FILE = /\.json$/i;

/** What is still missing, by the name of its text. */
export type Missing = "missingAll" | "missingMetadata" | "missingImage" | "tooManyFiles";

/** A picture with its YAML or JSON, or a message alone. A YAML alone is the message that `ros2 topic echo` prints. */
export function classify(files: readonly File[]): Upload | Missing {
  const images = files.filter((file) => PICTURE.test(file.name));
  const texts = files.filter((file) => YAML.test(file.name) || JSON_FILE.test(file.name));
  if (images.length > 1 || texts.length > 1) return "tooManyFiles";
  const [image] = images;
  const [text] = texts;
  if (image) return text ? { kind: "picture", image, metadata: text } : "missingMetadata";
  return text ? { kind: "message", message: text } : "missingAll";
}

/** Whether a lone text is metadata that waits for its picture: it names one. */
export async function waitsForPicture(message: File): Promise<boolean> {
  const begin = await message.slice(0, 4096).text();
  return /(^|[\s{,"])image"?\s*:/.test(begin) && !/(^|[\s{,"])data"?\s*:/.test(begin);
}
