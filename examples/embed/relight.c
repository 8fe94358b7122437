/* SPDX-License-Identifier: Apache-2.0 */
/* Shows a scene while it is edited: renders it, changes one parameter, renders it again.
 *
 *     cc relight.c -o relight -loriel
 *     ./relight SCENE.mi ELEMENT.PARAMETER=VALUE [PICTURE.exr]
 */
#include <oriel/oriel.h>
#include <stdio.h>
#include <stdlib.h>

static int check(OrielResult result, const char* what) {
  if (result == ORIEL_OK) return 1;
  fprintf(stderr, "%s: %s\n", what, oriel_last_error());
  return 0;
}

/* Mean of the newest picture's red, green and blue. */
static int print_mean(OrielSession* session, const char* name) {
  OrielPicture* picture = NULL;
  OrielPictureInfo info = {sizeof info};
  double sum[3] = {0, 0, 0};
  float* pixels;
  size_t i, count;
  if (!check(oriel_picture_acquire(session, &picture), "picture")) return 0;
  oriel_picture_info(picture, &info);
  count = (size_t)info.w * (size_t)info.h;
  pixels = malloc(count * 3 * sizeof *pixels);
  if (!pixels || !check(oriel_picture_read(picture, 0, pixels, 3 * count), "pixels")) {
    free(pixels);
    oriel_picture_release(picture);
    return 0;
  }
  for (i = 0; i < 3 * count; ++i) sum[i % 3] += pixels[i];
  printf("%s: %dx%d, %u samples, mean %.4f %.4f %.4f\n", name, info.w, info.h, info.samples,
         sum[0] / (double)count, sum[1] / (double)count, sum[2] / (double)count);
  free(pixels);
  oriel_picture_release(picture);
  return 1;
}

static int show(OrielSession* session, const char* edit, const char* file) {
  OrielView view;
  uint32_t epoch = 0;
  oriel_init_view(&view);
  view.samples = 16;
  if (!check(oriel_session_set_view(session, &view, &epoch), "view")) return 0;
  if (!check(oriel_session_start(session), "start")) return 0;
  if (!check(oriel_session_wait(session, epoch, UINT32_MAX, -1), "render")) return 0;
  if (!print_mean(session, "before")) return 0;
  if (!check(oriel_session_edit(session, edit, &epoch), "edit")) return 0;
  if (!check(oriel_session_wait(session, epoch, UINT32_MAX, -1), "render")) return 0;
  if (!print_mean(session, "after")) return 0;
  return !file || check(oriel_session_save_picture(session, file), file);
}

int main(int argc, char** argv) {
  OrielSession* session = NULL;
  int done;
  if (argc < 3) {
    fprintf(stderr, "usage: relight SCENE.mi ELEMENT.PARAMETER=VALUE [PICTURE.exr]\n");
    return 2;
  }
  if (!check(oriel_session_open(argv[1], NULL, &session), "open")) return 1;
  done = show(session, argv[2], argc > 3 ? argv[3] : NULL);
  oriel_session_close(session);
  return done ? 0 : 1;
}
