// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// FormReader: the form of a text as the language server reads it. What a person does with the form
// is done to the text that it was read from; so it is read again before, where the text is another.

import type { Language } from '../language/language.svelte';
import type { TextForm } from '../language/forms';

/** What it needs of the page around it. */
export interface FormHost {
  readonly language: Language;
  text(path: string): string | undefined;
}

export class FormReader {
  form = $state.raw<TextForm | null>(null);
  /** What the form was read from. */
  private of = { path: '', text: '', rule: '' };
  private reading: Promise<void> = Promise.resolve();

  constructor(private readonly host: FormHost) {}

  /** Reads the form of a text with the rule of a name in it. */
  read(path: string, rule: string): Promise<void> {
    // One after the other: the last one counts.
    this.reading = this.reading.then(() => this.readNow(path, rule));
    return this.reading;
  }

  /** The form of the text as it is now; null where there is none. */
  async fresh(): Promise<TextForm | null> {
    await this.reading;
    const { path, rule } = this.of;
    if (this.host.text(path) !== this.of.text) await this.read(path, rule);
    return this.host.text(path) === this.of.text ? this.form : null;
  }

  private async readNow(path: string, rule: string): Promise<void> {
    for (let tries = 0; tries < 3; ++tries) {
      const text = this.host.text(path);
      if (text === undefined) return;
      if (this.form && path === this.of.path && rule === this.of.rule && text === this.of.text)
        return;
      const form = await this.host.language.tell<TextForm>('gable/form', path, { rule });
      if (!form) return;
      if (this.host.text(path) !== text) continue;
      this.of = { path, text, rule };
      this.form = form;
      return;
    }
  }
}
