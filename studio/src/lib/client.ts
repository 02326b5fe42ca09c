// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// EngineClient: the one way from the page to the engine, over a transport.

import {
  decodeDerived,
  decodeModel,
  decodeTree,
  type Derived,
  type DrawList,
  type LeafInfo,
  type Diagnostic,
  type ModelPreview,
  type PartsBelow,
  type Tree,
} from './protocol';
import type { Held } from './chunks';
import type { Transport } from './transport';

export interface ProjectFile {
  path: string;
  bytes: number;
  stamp: string;
}

export interface ProjectInfo {
  root: string;
  name: string;
  version: string;
  files: ProjectFile[];
}

export interface Example {
  name: string;
  title: string;
  text: string;
  notation: string;
  picture: boolean;
  shapes: boolean;
  arguments: string;
  /** Where its picture was taken from, as arguments. */
  view: string;
}

export type ShapesSpec =
  { lot: [number, number] } | { file: string; only?: number[] } | { polygon: [number, number][] };

/** An initial shape in plan: x east, y north. */
export interface Outline {
  name: string;
  area: number;
  ring: [number, number][];
}

export interface AssetRequest {
  path: string;
  to: string;
  pivot: number[];
  size: number[];
  rotate: number[];
  zUp: boolean;
  name: string;
  expected: string;
}

export interface ExportNews {
  busy: boolean;
  done: number;
  total: number;
  bytes: number;
}

export interface DeriveRequest {
  page: string;
  file: string;
  text: string;
  overlay: Record<string, string>;
  start: string;
  style?: string;
  seed: number;
  attributes: Record<string, string>;
  /** Of single initial shapes, by index. */
  seeds?: Record<string, number>;
  shapes: ShapesSpec;
  limits?: { seconds?: number; shapes?: number };
}

/** What a picture is taken of: as the view shows it. */
export interface PictureView {
  eye: [number, number, number];
  target: [number, number, number];
  /** The horizontal angle of view, in degrees. */
  angle: number;
  width: number;
  height: number;
  /** Degrees above the horizon, and from north over east. */
  sun: Sun;
}

export interface Sun {
  elevation: number;
  azimuth: number;
}

/** What was refused, with its code. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    readonly code: string,
    message: string,
  ) {
    super(message);
  }
}

const TAB = 'gable.tab';

/** A tab keeps its name when it is loaded again. */
function nameOfTab(): string {
  const name = sessionStorage.getItem(TAB) ?? crypto.randomUUID();
  sessionStorage.setItem(TAB, name);
  return name;
}

export class EngineClient {
  readonly page = crypto.randomUUID();
  readonly tab = nameOfTab();
  /** Of the large model that the page shows, so that the next one comes as what has changed. */
  private held: Held | null = null;

  constructor(readonly transport: Transport) {}

  /** Whether files outlast the page, and pictures are drawn: not in the playground. */
  get kept(): boolean {
    return this.transport.kept;
  }

  private async call(
    method: string,
    path: string,
    body?: string | Blob,
    signal?: AbortSignal,
  ): Promise<Response> {
    const answer = await this.transport.send(method, path, body, signal);
    if (answer.ok) return answer;
    const text = await answer.text();
    try {
      const said = JSON.parse(text) as { code: string; message: string };
      throw new Refusal(answer.status, said.code, said.message);
    } catch (error) {
      if (error instanceof Refusal) throw error;
      throw new Refusal(answer.status, 'refused', text.trim() || answer.statusText);
    }
  }

  async project(): Promise<ProjectInfo> {
    return (await this.call('GET', 'project')).json() as Promise<ProjectInfo>;
  }

  async ops(): Promise<unknown> {
    return (await this.call('GET', 'ops')).json();
  }

  async read(path: string): Promise<{ text: string; version: string }> {
    const answer = await this.call('GET', `file?path=${encodeURIComponent(path)}`);
    return { text: await answer.text(), version: answer.headers.get('X-Gable-Version') ?? '' };
  }

  async readBytes(path: string): Promise<ArrayBuffer> {
    return (await this.call('GET', `file?path=${encodeURIComponent(path)}`)).arrayBuffer();
  }

  /** Writes where the file still is the version expected; "none" for a file that is new. */
  async write(path: string, content: string | Blob, expected: string): Promise<string> {
    const query = `file?path=${encodeURIComponent(path)}&expected=${expected}`;
    const answer = (await (await this.call('PUT', query, content)).json()) as { version: string };
    return answer.version;
  }

  /** Makes files that are not there yet: all of them, or none. */
  async create(files: [string, string | Blob][]): Promise<void> {
    const blobs = files.map(([path, content]): [string, Blob] => [path, new Blob([content])]);
    const list = JSON.stringify(blobs.map(([path, blob]) => [path, blob.size]));
    await this.call('POST', 'files', new Blob([`${list}\n`, ...blobs.map(([, blob]) => blob)]));
  }

  async recovery(path: string): Promise<string | null> {
    const answer = await this.call('GET', `recovery?path=${encodeURIComponent(path)}`);
    return answer.status === 204 ? null : answer.text();
  }

  async keepRecovery(path: string, text: string): Promise<void> {
    await this.call('PUT', `recovery?path=${encodeURIComponent(path)}`, text);
  }

  async dropRecovery(path: string): Promise<void> {
    await this.call('DELETE', `recovery?path=${encodeURIComponent(path)}`);
  }

  async derive(
    request: DeriveRequest,
    signal: AbortSignal,
  ): Promise<{ derived: Derived; draw: DrawList | null }> {
    const own = request.page === this.page;
    const asked = own ? { ...request, known: this.held?.derivation ?? 0 } : request;
    const answer = await this.call('POST', 'derive', JSON.stringify(asked), signal);
    const { derived, draw, held } = decodeDerived(
      await answer.arrayBuffer(),
      own ? this.held : null,
    );
    if (own) this.held = held;
    return { derived, draw };
  }

  /** The derivation tree; `steps`: with a draw list of the shapes of all steps. */
  async tree(
    request: DeriveRequest,
    signal: AbortSignal,
    steps = false,
  ): Promise<{ tree: Tree; draw: DrawList | null }> {
    const own = { ...request, steps, page: `${request.page} tree` };
    const answer = await this.call('POST', 'tree', JSON.stringify(own), signal);
    return decodeTree(await answer.arrayBuffer());
  }

  async leaf(derivation: number, leaf: number): Promise<LeafInfo> {
    return (
      await this.call('GET', `leaf?derivation=${derivation}&leaf=${leaf}`)
    ).json() as Promise<LeafInfo>;
  }

  /** What lies below part `level` of those above a leaf; at level 0 the initial shapes. */
  async parts(derivation: number, leaf: number, level: number): Promise<PartsBelow> {
    const query = `parts?derivation=${derivation}&leaf=${leaf}&level=${level}`;
    return (await this.call('GET', query)).json() as Promise<PartsBelow>;
  }

  async progress(): Promise<{ done: number; total: number }> {
    const answer = await this.call('GET', `progress?page=${encodeURIComponent(this.page)}`);
    return answer.json() as Promise<{ done: number; total: number }>;
  }

  /**
   * A model as a file; `received` hears of its bytes. The extension is "obj.zip" for several files.
   */
  async exported(
    derivation: number,
    format: string,
    signal: AbortSignal,
    received: (bytes: number, total: number) => void = () => undefined,
    picture: PictureView | null = null,
  ): Promise<{ blob: Blob; extension: string }> {
    const camera = picture
      ? `&camera=${JSON.stringify([...picture.eye, ...picture.target, picture.angle])}` +
        `&size=${JSON.stringify([picture.width, picture.height])}` +
        `&sun=${JSON.stringify([picture.sun.elevation, picture.sun.azimuth])}`
      : '';
    const answer = await this.call(
      'GET',
      `export?derivation=${derivation}&format=${format}&page=${this.page}${camera}`,
      undefined,
      signal,
    );
    const total = Number(answer.headers.get('Content-Length') ?? 0);
    const chunks: Uint8Array<ArrayBuffer>[] = [];
    let bytes = 0;
    const reader = answer.body?.getReader();
    for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
      chunks.push(part.value);
      received((bytes += part.value.length), total);
    }
    return { blob: new Blob(chunks), extension: answer.headers.get('X-Gable-Extension') ?? format };
  }

  /** Of a day and an hour by the sun, over a place or the model; null for one on no map. */
  async sun(
    derivation: number,
    day: [number, number, number],
    hour: number,
    place: [number, number] | null,
  ): Promise<Sun | null> {
    const where = place ? `&place=${JSON.stringify(place)}` : '';
    const path = `sun?derivation=${derivation}&day=${JSON.stringify(day)}&hour=${hour}${where}`;
    return (await this.call('GET', path)).json() as Promise<Sun | null>;
  }

  async exportNews(): Promise<ExportNews> {
    return (
      await this.call('GET', `export-progress?page=${this.page}`)
    ).json() as Promise<ExportNews>;
  }

  async converted(
    path: string,
    text: string,
  ): Promise<{ text: string; diagnostics: Diagnostic[] }> {
    return (
      await this.call('POST', `convert?path=${encodeURIComponent(path)}`, text)
    ).json() as Promise<{ text: string; diagnostics: Diagnostic[] }>;
  }

  async outlines(
    shapes: ShapesSpec,
  ): Promise<{ count: number; shapes: Outline[]; diagnostics: Diagnostic[] }> {
    return (await this.call('POST', 'shapes', JSON.stringify({ shapes }))).json() as Promise<{
      count: number;
      shapes: Outline[];
      diagnostics: Diagnostic[];
    }>;
  }

  async model(path: string): Promise<ModelPreview> {
    return decodeModel(
      await (await this.call('GET', `model?path=${encodeURIComponent(path)}`)).arrayBuffer(),
    );
  }

  async prepareAsset(request: AssetRequest): Promise<{ version: string; bounds: number[] }> {
    return (await this.call('POST', 'asset', JSON.stringify(request))).json() as Promise<{
      version: string;
      bounds: number[];
    }>;
  }

  async texture(derivation: number, path: string): Promise<Blob> {
    const query = `texture?derivation=${derivation}&path=${encodeURIComponent(path)}`;
    return (await this.call('GET', query)).blob();
  }

  async examples(): Promise<Example[]> {
    return (await this.call('GET', 'examples')).json() as Promise<Example[]>;
  }

  async examplePicture(name: string): Promise<Blob> {
    return (await this.call('GET', `example-picture?name=${encodeURIComponent(name)}`)).blob();
  }

  async copyExample(name: string): Promise<string> {
    const answer = await this.call('POST', `example-copy?name=${encodeURIComponent(name)}`);
    return ((await answer.json()) as { folder: string }).folder;
  }
}
