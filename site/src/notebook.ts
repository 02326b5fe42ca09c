// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A notebook of Jupyter as Markdown: its words, its code, and what stands below each cell.

interface Output {
  output_type: string;
  text?: string[];
  data?: Record<string, string | string[]>;
}

interface Cell {
  cell_type: string;
  source: string | string[];
  outputs?: Output[];
}

const joined = (text: string | string[] | undefined): string =>
  typeof text === 'string' ? text : (text ?? []).join('');

function outputOf({ output_type, text, data }: Output): string {
  const picture = joined(data?.['image/png']).replace(/\s/g, '');
  if (picture) return `![What the cell shows](data:image/png;base64,${picture})\n\n`;
  const words = output_type === 'stream' ? joined(text) : joined(data?.['text/plain']);
  return words ? `\`\`\`text\n${words.replace(/\n?$/, '\n')}\`\`\`\n\n` : '';
}

export function notebookText(json: string): string {
  const cells = (JSON.parse(json) as { cells: Cell[] }).cells;
  return cells
    .map(({ cell_type, source, outputs }) => {
      const text = joined(source);
      if (cell_type === 'markdown') return `${text}\n\n`;
      return `\`\`\`python\n${text}\n\`\`\`\n\n${(outputs ?? []).map(outputOf).join('')}`;
    })
    .join('');
}
