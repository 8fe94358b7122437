// SPDX-License-Identifier: Apache-2.0
// Requests by HTTP: results, thumbnails and uploads. Each carries the token in a header.

/**
 * @param {string} path
 * @param {string} token
 * @param {RequestInit} [options]
 */
async function call(path, token, options = {}) {
  const answer = await fetch(path, {...options, headers: {"X-Oriel-Token": token}});
  if (answer.ok) return answer;
  let text = `Status ${answer.status}`;
  try {
    text = (await answer.json()).message ?? text;
  } catch {
    // The body is not JSON; the status remains.
  }
  throw new Error(text);
}

/** Downloads a result as a file. @param {string} url @param {string} token @param {string} name */
export async function downloadResult(url, token, name) {
  if (!url.startsWith("/api/")) throw new Error("The address of the result is not valid.");
  saveBlob(await (await call(url, token)).blob(), name);
}

/** Offers data to the user as a file. @param {Blob} blob @param {string} name */
export function saveBlob(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/**
 * Address of a thumbnail as a blob, or null if the texture cannot be read. The caller revokes it.
 * @param {string} texture @param {import("../scene/session.js").Session} session
 * @returns {Promise<string | null>}
 */
export async function thumbnailUrl(texture, session) {
  try {
    const {url} = await session.request("thumbnail", {texture});
    if (!String(url).startsWith("/api/thumbnail/")) return null;
    return URL.createObjectURL(await (await call(url, session.token)).blob());
  } catch {
    return null;
  }
}

/**
 * A file name of the characters that the server accepts.
 * @param {string} name
 */
export function plainFileName(name) {
  const plain = name.replace(/[^A-Za-z0-9._ -]/g, "_").replace(/^[. ]+/, "");
  return plain || "texture";
}

/** @param {File} file @param {string} token @returns {Promise<string>} path below the scene's folder */
export async function uploadTexture(file, token) {
  const name = encodeURIComponent(plainFileName(file.name));
  const answer = await call(`/api/upload?name=${name}`, token, {method: "POST", body: file});
  return (await answer.json()).file;
}
