// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures of model files, for the offers of the editor. One canvas out of sight draws them all.

import type { EngineClient } from '../lib/client';
import type { ModelPreview } from '../lib/protocol';
import { Thumbnails } from './thumbnails';

const WIDTH = 220;
const HEIGHT = 150;

let drawer: Thumbnails | null = null;

function drawerOf(client: EngineClient): Thumbnails {
  if (drawer) return drawer;
  const canvas = document.createElement('canvas');
  canvas.style.cssText = `position:fixed;left:-1000px;top:0;width:${WIDTH}px;height:${HEIGHT}px`;
  canvas.setAttribute('aria-hidden', 'true');
  document.body.append(canvas);
  return (drawer = new Thumbnails(canvas, client));
}

export async function modelPicture(
  client: EngineClient,
  model: ModelPreview,
): Promise<HTMLCanvasElement> {
  const picture = await drawerOf(client).drawModel(model);
  const out = document.createElement('canvas');
  out.width = picture.width;
  out.height = picture.height;
  out.style.cssText = `width:${WIDTH}px;height:${HEIGHT}px`;
  out.getContext('2d')!.drawImage(picture, 0, 0);
  return out;
}
